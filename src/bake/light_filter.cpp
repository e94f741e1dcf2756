// SPDX-License-Identifier: Apache-2.0
#include "light_filter.h"

#include <algorithm>

namespace kiln {
namespace {

// Point masses that are spread leave a little below zero beside a sun.
void clip_below_zero(std::vector<Layers>& images) {
  for (Layers& image : images) {
    for (Layer& layer : image.layers) {
      for (int y = 0; y < image.size.height; ++y) {
        float* row = layer.plane.row(y);
        for (int x = 0; x < image.size.width; ++x) row[x] = std::max(row[x], 0.0f);
      }
    }
  }
}

}  // namespace

LightFilter::LightFilter(const Light& light, const std::vector<FilterLobe>& lobes) : light_(light) {
  std::vector<FilterLobe> wide, narrow;
  for (const FilterLobe& lobe : lobes) (sees_picture(lobe) ? narrow : wide).push_back(lobe);
  if (!wide.empty()) masses_.emplace(light.masses(), wide);
  if (!narrow.empty()) picture_.emplace(light.latlong, narrow);
}

// A lobe has about 8 / alpha bands, as many as the picture must have columns to show it.
bool LightFilter::sees_picture(const FilterLobe& lobe) const {
  return light_.spread && 8 / lobe.alpha > light_.latlong.size.width;
}

FilteredLevel LightFilter::filter(const FilterLobe& lobe, const SphereGrid& grid) const {
  if (sees_picture(lobe)) return {lobe, grid, picture_->filter(lobe, grid)};
  std::vector<Layers> images = masses_->filter(lobe, grid);
  if (light_.spread && light_.fixed.negative == 0) clip_below_zero(images);
  return {lobe, grid, std::move(images)};
}

std::vector<FilterError> LightFilter::errors(const std::vector<FilteredLevel>& levels,
                                             double mean_radiance) const {
  std::vector<FilterError> errors(levels.size());
  for (const bool of_picture : {false, true}) {
    std::vector<FilteredLevel> some;
    std::vector<size_t> places;
    for (size_t i = 0; i < levels.size(); ++i) {
      if (sees_picture(levels[i].lobe) != of_picture) continue;
      some.push_back(levels[i]);
      places.push_back(i);
    }
    if (some.empty()) continue;
    const auto found = filter_errors(of_picture ? *picture_ : *masses_, some, mean_radiance);
    for (size_t i = 0; i < places.size(); ++i) errors[places[i]] = found[i];
  }
  return errors;
}

}  // namespace kiln

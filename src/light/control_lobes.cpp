// SPDX-License-Identifier: Apache-2.0
#include "kiln/light/control_lobes.h"

#include <algorithm>
#include <cmath>

#include "kiln/parallel/rows.h"
#include "zonal_kernel.h"

namespace kiln {
namespace {

// Rows of the lat-long grid whose nodes the lobes of a width stand around: so near each other that
// four of them mixed are like one in between.
int rows_for(double alpha) { return std::max(16, static_cast<int>(std::ceil(8 / alpha))); }
constexpr int cosine_rows = 32;

// Rows and columns that hold what lies between the texels of the source, as it is looked up: along
// a row straight lines are expanded exactly, from row to row they are sampled.
constexpr int enough_rows = 1024, enough_columns = 512;

// Even, so that texels do not straddle what is bent.
int times_for(int found, int enough) {
  return found >= enough ? 1 : ((enough + found - 1) / found + 1) / 2 * 2;
}

/// The environment as it is looked up, at the texel centres of a finer image.
Layers looked_up(const Environment& environment) {
  using F = WideFloat;
  const Size cells = environment.cells();
  const int across = environment.is_node_aligned()
                         ? std::max(2, times_for(cells.width, enough_columns))
                         : times_for(cells.width, enough_columns);
  Layers image = make_layers(
      {cells.width * across, cells.height * times_for(cells.height, enough_rows)}, {"R", "G", "B"});
  const F texel(1 / static_cast<float>(image.size.width));
  float centres[lane_count<F>];
  for (int i = 0; i < lane_count<F>; ++i) centres[i] = static_cast<float>(i) + 0.5f;
  const F first = load_lanes<F>(centres);
  for_rows(image.size.height, [&](int y) {
    const F v((static_cast<float>(y) + 0.5f) / static_cast<float>(image.size.height));
    for (int x = 0; x < image.size.width; x += lane_count<F>) {
      const Vec3<F> radiance = environment.radiance_in_image(
          Vec2<F>{min((first + F(static_cast<float>(x))) * texel, F(1.0f)), v});
      store_lanes(image.layers[0].plane.row(y) + x, radiance.x);
      store_lanes(image.layers[1].plane.row(y) + x, radiance.y);
      store_lanes(image.layers[2].plane.row(y) + x, radiance.z);
    }
  });
  return image;
}

}  // namespace

ControlLobes::ControlLobes(const Environment& environment) : turn_(environment.rotate_deg()) {
  const double octaves = -std::log2(least_alpha);
  const int widths = 1 + static_cast<int>(std::ceil(octaves * widths_per_octave));
  std::vector<FilterLobe> lobes;
  for (int i = 0; i < widths; ++i) {
    const double alpha = std::min(1.0, least_alpha * std::exp2(i / widths_per_octave));
    lobes.push_back({.alpha = alpha, .masked = true});
    alpha2_.push_back(static_cast<float>(alpha * alpha));
    if (i + 1 < widths) add_grid(rows_for(alpha));
  }
  const int of_cosines = widths - 1;
  add_grid(cosine_rows);
  const FilterLobe cosine{};
  std::vector<FilterLobe> all = lobes;
  all.push_back(cosine);
  const Layers source = looked_up(environment);
  const Prefilter filtered(source, all, Across::Straight);
  for (int i = 0; i < widths; ++i) {
    const FilterLobe& lobe = lobes[static_cast<size_t>(i)];
    per_integral_.push_back(static_cast<float>(1 / filtered.integral_of(lobe)));
    std::vector<Place> places;
    if (i > 0) places.push_back({i - 1, 1});
    if (i + 1 < widths) places.push_back({i, 0});
    fill(filtered, lobe, places);
  }
  fill(filtered, cosine, {{of_cosines, 0}});
}

void ControlLobes::add_grid(int rows) {
  rows_.push_back(static_cast<float>(rows));
  firsts_.push_back(static_cast<std::int32_t>(nodes_.size()));
  nodes_.resize(nodes_.size() +
                static_cast<size_t>(2 * rows) * static_cast<size_t>(rows) * node_numbers);
}

void ControlLobes::fill(const Prefilter& filtered, const FilterLobe& lobe,
                        const std::vector<Place>& places) {
  std::vector<SphereGrid> grids;
  grids.reserve(places.size());
  for (const Place& place : places) {
    grids.push_back({.layout = SphereLayout::LatLong,
                     .size = static_cast<int>(rows_[static_cast<size_t>(place.grid)]),
                     .at_nodes = true});
  }
  const std::vector<std::vector<Layers>> images = filtered.filter_each(lobe, grids);
  for (size_t i = 0; i < places.size(); ++i) store(images[i].front(), places[i]);
}

void ControlLobes::store(const Layers& image, const Place& place) {
  float* to = nodes_.data() + firsts_[static_cast<size_t>(place.grid)] + 4 * place.width;
  for (int y = 0; y < image.size.height; ++y) {
    for (int x = 0; x < image.size.width; ++x, to += node_numbers) {
      for (size_t c = 0; c < 3; ++c) to[c] = image.layers[c].plane.at(x, y);
    }
  }
}

}  // namespace kiln

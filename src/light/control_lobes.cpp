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
  }
  const FilterLobe cosine{};
  std::vector<FilterLobe> all = lobes;
  all.push_back(cosine);
  const Layers source = looked_up(environment);
  const Prefilter filtered(source, all, Across::Straight);
  for (const FilterLobe& lobe : lobes) {
    per_integral_.push_back(static_cast<float>(1 / filtered.integral_of(lobe)));
  }
  for (size_t i = 0; i + 1 < lobes.size(); ++i) {
    add_grid(filtered, {lobes[i], lobes[i + 1]}, rows_for(lobes[i].alpha));
  }
  add_grid(filtered, {cosine}, cosine_rows);
}

void ControlLobes::add_grid(const Prefilter& filtered, const std::vector<FilterLobe>& lobes,
                            int rows) {
  const SphereGrid grid{.layout = SphereLayout::LatLong, .size = rows, .at_nodes = true};
  const size_t first = nodes_.size();
  rows_.push_back(static_cast<float>(rows));
  firsts_.push_back(static_cast<std::int32_t>(first));
  nodes_.resize(first + static_cast<size_t>(2 * rows) * static_cast<size_t>(rows) * node_numbers);
  for (size_t width = 0; width < lobes.size(); ++width) {
    const Layers image = filtered.filter(lobes[width], grid).front();
    for (int y = 0; y < rows; ++y) {
      float* row = nodes_.data() + first +
                   static_cast<size_t>(y) * static_cast<size_t>(2 * rows) * node_numbers +
                   4 * width;
      for (size_t c = 0; c < 3; ++c) {
        const float* from = image.layers[c].plane.row(y);
        for (int x = 0; x < 2 * rows; ++x) row[x * node_numbers + static_cast<int>(c)] = from[x];
      }
    }
  }
}

}  // namespace kiln

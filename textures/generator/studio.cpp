// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cmath>

#include "environments.h"
#include "kiln/image/projection.h"
#include "kiln/parallel/rows.h"
#include "noise.h"

namespace kiln::textures {
namespace {

using Direction = Vec3<double>;

/// A rectangle of light one unit away, seen square on.
struct Panel {
  Direction toward;
  double half_width, half_height;  ///< [unit]
  double softness;                 ///< width of its edge [unit]
  Color radiance;                  ///< in its middle
};

const std::array<Panel, 5> panels = {{
    {{0.74, 0.46, 0.52}, 0.42, 0.46, 0.10, {10.4, 8.8, 6.9}},     // key
    {{-0.93, 0.10, 0.16}, 0.10, 0.85, 0.05, {6.4, 9.2, 12.6}},    // rim strip
    {{0.06, 0.90, -0.30}, 0.44, 0.20, 0.08, {7.2, 7.2, 7.0}},     // overhead
    {{-0.22, 0.10, 0.97}, 0.34, 0.26, 0.20, {0.62, 0.66, 0.72}},  // card behind the camera
    {{0.28, 0.06, -0.95}, 0.30, 0.50, 0.25, {0.90, 0.42, 0.24}},  // glow on the back wall
}};

Color light_of(const Panel& panel, const Direction& d) {
  const Direction ahead = normalize(panel.toward);
  const double nearness = dot(d, ahead);
  if (nearness <= 0.05) return {};
  const Direction right = normalize(cross(Direction{0, 1, 0.001}, ahead));
  const Direction up = cross(ahead, right);
  const double x = std::abs(dot(d, right) / nearness), y = std::abs(dot(d, up) / nearness);
  const double inside =
      smooth_step(panel.half_width + panel.softness, panel.half_width - panel.softness, x) *
      smooth_step(panel.half_height + panel.softness, panel.half_height - panel.softness, y);
  const double rx = x / panel.half_width, ry = y / panel.half_height;
  return panel.radiance * (inside * (1 - 0.22 * std::min(rx * rx + ry * ry, 2.0)));
}

/// Walls, floor and ceiling without lamps.
Color room(const Direction& d) {
  const Color floor{0.105, 0.100, 0.096}, wall{0.060, 0.061, 0.064}, ceiling{0.018, 0.018, 0.020};
  const Color below = mix(wall, floor, smooth_step(-0.10, -0.30, d.y));
  return mix(below, ceiling, smooth_step(0.0, 0.8, d.y)) * (1 + 0.25 * d.x);
}

Color radiance(const Direction& d) {
  Color sum = room(d);
  for (const Panel& panel : panels) sum += light_of(panel, d);
  return sum;
}

Color mean_radiance(Size size, int x, int y) {
  constexpr int grid = 4;
  Color sum{};
  for (int i = 0; i < grid * grid; ++i) {
    const Point uv{(x + (i % grid + 0.5) / grid) / size.width,
                   (y + (i / grid + 0.5) / grid) / size.height};
    sum += radiance(latlong_to_direction(uv)) * (1.0 / (grid * grid));
  }
  return sum;
}

Layers paint(Size size) {
  Layers image = make_layers(size, {"R", "G", "B"});
  for_rows(size.height, [&](int y) {
    for (int x = 0; x < size.width; ++x) {
      const Color color = mean_radiance(size, x, y);
      image.layers[0].plane.at(x, y) = shortened(color.x);
      image.layers[1].plane.at(x, y) = shortened(color.y);
      image.layers[2].plane.at(x, y) = shortened(color.z);
    }
  });
  return image;
}

}  // namespace

Surroundings studio() { return {"studio", {512, 256}, paint}; }

}  // namespace kiln::textures

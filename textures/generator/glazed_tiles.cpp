// SPDX-License-Identifier: Apache-2.0
// Hand-made wall tiles, four by four: a pooling glaze over clay, crackled here and there, in grout.
#include <algorithm>
#include <array>
#include <cmath>

#include "surface.h"

namespace kiln::textures {
namespace {

constexpr int tiles_across = 4;
const std::array<Color, 6> glazes = {{{0.020, 0.175, 0.180},
                                      {0.030, 0.235, 0.200},
                                      {0.014, 0.105, 0.150},
                                      {0.060, 0.300, 0.245},
                                      {0.550, 0.490, 0.360},
                                      {0.018, 0.140, 0.165}}};
const Color grout{0.310, 0.285, 0.250};
const Color soot{0.075, 0.062, 0.050};

/// The tile under a point: which one, where in it, how far inside its border.
struct Place {
  int x, y;
  Point inside;   ///< [-1,1]^2
  double margin;  ///< distance to the border, negative in the grout [half tile]
};

Place place(Point uv) {
  const Point bent = warped(uv, {16, 16}, 0.0016, 3);
  const double px = wrap(bent.x) * tiles_across, py = wrap(bent.y) * tiles_across;
  const int x = static_cast<int>(px) % tiles_across, y = static_cast<int>(py) % tiles_across;
  const Point inside{2 * (px - std::floor(px)) - 1, 2 * (py - std::floor(py)) - 1};
  // A square with round corners, a little smaller than its share of the wall.
  constexpr double half = 0.925, corner = 0.10;
  const double qx = std::abs(inside.x) - (half - corner), qy = std::abs(inside.y) - (half - corner);
  const double outside =
      std::hypot(std::max(qx, 0.0), std::max(qy, 0.0)) + std::min(std::max(qx, qy), 0.0);
  return {x, y, inside, corner - outside};
}

Spot grout_spot(Point uv) {
  const double grain = fractal_noise(uv, {64, 64}, 3, 21);
  const double dirt = smooth_step(-0.25, 0.45, fractal_noise(uv, {5, 5}, 5, 22));
  Spot s;
  s.color = mix(grout, soot, 0.75 * dirt) * (1 + 0.22 * grain);
  s.roughness = 0.88 + 0.07 * grain;
  s.level = 0.30 - 0.12 * dirt;
  s.height = 0.16 + 0.05 * grain;
  return s;
}

/// Hair cracks in the glaze of some tiles.
double crackle(Point uv, double affected) {
  const Nearest cell =
      nearest_seed(warped(warped(uv, {14, 14}, 0.010, 41), {60, 60}, 0.003, 43), {30, 30}, 42);
  const double open = smooth_step(-0.25, 0.20, fractal_noise(uv, {9, 9}, 3, 44));
  return open * smooth_step(0.034, 0.006, cell.to_border) * smooth_step(0.62, 0.72, affected);
}

Spot glaze_spot(Point uv, const Place& at) {
  const auto draw = [&](std::uint32_t what) { return chance(at.x, at.y, 500 + what); };
  const Color& hue = glazes[static_cast<size_t>(draw(0) * glazes.size())];
  const double wave = fractal_noise(uv, {7, 7}, 3, 31);
  const double thin = smooth_step(0.13, 0.01, at.margin);  // glaze runs off the rim ...
  const double thick =
      smooth_step(-0.4, 0.6, wave + 0.5 * (draw(1) - 0.5));  // ... and gathers in hollows
  const double crack = crackle(uv, draw(2));
  const double worn =
      smooth_step(0.18, 0.50, fractal_noise(warped(uv, {4, 4}, 0.04, 51), {5, 5}, 5, 52));
  const double speck = smooth_step(0.16, 0.08, nearest_seed(uv, {46, 46}, 61).distance) *
                       smooth_step(0.72, 0.80, nearest_seed(uv, {46, 46}, 61).chance);

  Spot s;
  s.color = hue * (0.85 + 0.35 * draw(3)) * mix(1.25, 0.62, thick);
  s.color = mix(s.color, Color{0.40, 0.30, 0.18}, 0.55 * thin);
  s.color = mix(s.color, soot, 0.60 * crack + 0.65 * speck * (1 - crack));
  s.roughness = 0.05 + 0.09 * draw(4) + 0.05 * thick;
  s.roughness = mix(s.roughness, 0.42 + 0.06 * wave, 0.85 * worn);
  s.roughness = mix(s.roughness, 0.60, 0.8 * crack);
  s.level = mix(0.62 + 0.25 * draw(5), 0.46, 0.8 * worn);
  s.level = mix(s.level, 0.30, crack);
  const double tilt = 0.09 * ((draw(6) - 0.5) * at.inside.x + (draw(7) - 0.5) * at.inside.y);
  s.height = 0.80 + 0.10 * wave + tilt - 0.05 * crack -
             0.22 * std::pow(1 - std::min(at.margin / 0.28, 1.0), 2.2);
  return s;
}

Spot spot(Point uv) {
  const Place at = place(uv);
  const double glazed = smooth_step(-0.012, 0.022, at.margin);
  const Spot a = grout_spot(uv);
  if (glazed <= 0) return a;
  const Spot b = glaze_spot(uv, at);
  return {.color = mix(a.color, b.color, glazed),
          .specular = {},
          .level = mix(a.level, b.level, glazed),
          .roughness = mix(a.roughness, b.roughness, glazed),
          .metallic = 0,
          .height = mix(a.height, b.height, glazed)};
}

}  // namespace

Set glazed_tiles() {
  return {.folder = "glazed_tiles",
          .spot = spot,
          .relief = 7,
          .files = {{"glazed_tiles_diff.png", Map::Albedo},
                    {"glazed_tiles_rough.png", Map::Roughness},
                    {"glazed_tiles_spec.png", Map::SpecularLevel},
                    {"glazed_tiles_nor_gl.png", Map::NormalOpenGl},
                    {"glazed_tiles_ao.png", Map::Occlusion}}};
}

}  // namespace kiln::textures

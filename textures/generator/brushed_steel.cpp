// SPDX-License-Identifier: Apache-2.0
// Sheet steel, brushed along x, with heat tint, greasy smears and spots of dried oil.
#include <algorithm>
#include <cmath>

#include "surface.h"

namespace kiln::textures {
namespace {

const Color steel{0.60, 0.58, 0.555};
const Color straw{0.71, 0.53, 0.29};  // thin oxide, from heat
const Color bronze{0.49, 0.32, 0.25};
const Color blue{0.27, 0.32, 0.45};  // thick oxide
const Color dried_oil{0.085, 0.042, 0.014};

/// Streaks of the brush: long along x, fine across.
double brushing(Point uv) {
  return 0.5 * gradient_noise(uv, {3, 128}, 11) + 0.35 * gradient_noise(uv, {5, 256}, 12) +
         0.3 * gradient_noise(uv, {2, 48}, 13);
}

/// How much oxide stands on the steel: wandering bands, as above a weld.
double heat(Point uv) {
  const Point bent = warped(uv, {2, 2}, 0.10, 31);
  const double band = 0.5 + 0.5 * std::sin(2 * pi * (bent.y + 0.12));
  return smooth_step(0.50, 1.06, band + 0.10 * fractal_noise(uv, {4, 4}, 4, 33));
}

Color tinted(double oxide) {
  if (oxide < 0.4) return mix(steel, straw, oxide / 0.4);
  if (oxide < 0.7) return mix(straw, bronze, (oxide - 0.4) / 0.3);
  return mix(bronze, blue, (oxide - 0.7) / 0.3);
}

Spot spot(Point uv) {
  const double streak = brushing(uv);
  const double scratch = scratch_depth(uv, {.count = 34,
                                            .length = 0.5,
                                            .width = 0.0022,
                                            .angle_rad = 0.1,
                                            .spread_rad = 1.6,
                                            .seed = 51});
  const double smear =
      smooth_step(-0.05, 0.45, fractal_noise(warped(uv, {3, 3}, 0.05, 61), {3, 2}, 5, 62));
  const double stain_field = fractal_noise(warped(uv, {5, 5}, 0.03, 71), {4, 4}, 5, 72);
  const double stain = smooth_step(0.30, 0.37, stain_field);
  const double rim = stain * smooth_step(0.50, 0.37, stain_field);
  const double oxide = heat(uv);

  Spot s;
  s.color = tinted(oxide) * (1 + 0.10 * streak);
  s.color = mix(s.color, s.color * 0.86, smear);
  s.color = mix(s.color, dried_oil * (1 + 0.7 * rim), 0.92 * stain);
  s.metallic = 1 - 0.94 * stain;
  s.roughness = 0.30 + 0.10 * streak + 0.05 * oxide;
  s.roughness = mix(s.roughness, 0.16 + 0.04 * streak, smear);
  s.roughness =
      mix(s.roughness, 0.62 - 0.22 * rim + 0.1 * fractal_noise(uv, {32, 32}, 3, 81), stain);
  s.roughness += 0.16 * scratch;
  s.height = 0.5 + 0.16 * streak * (1 - 0.8 * stain) - 0.40 * scratch * (1 - stain) + 0.25 * stain +
             0.12 * rim;
  return s;
}

}  // namespace

Set brushed_steel() {
  return {.folder = "brushed_steel",
          .spot = spot,
          .relief = 1.1,
          .files = {{"BrushedSteel_Color.png", Map::Albedo},
                    {"BrushedSteel_Roughness.png", Map::Roughness},
                    {"BrushedSteel_Metalness.png", Map::Metallic},
                    {"BrushedSteel_NormalGL.png", Map::NormalOpenGl}}};
}

}  // namespace kiln::textures

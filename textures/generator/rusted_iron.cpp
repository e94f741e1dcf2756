// SPDX-License-Identifier: Apache-2.0
// Plate iron under mill scale, eaten by rust from patches that have grown together.
#include <algorithm>
#include <cmath>

#include "surface.h"

namespace kiln::textures {
namespace {

const Color iron{0.400, 0.385, 0.370};
const Color scale{0.052, 0.050, 0.054};  // magnetite left by rolling: dark and not a metal
const Color deep_rust{0.075, 0.022, 0.008};
const Color red_rust{0.235, 0.070, 0.018};
const Color young_rust{0.480, 0.190, 0.045};

/// How far rust has come: below 0 none, 0 its front, above 0 inside.
double rust_depth(Point uv) {
  const Point grown = warped(uv, {4, 4}, 0.055, 11);
  return fractal_noise(grown, {3, 3}, 7, 12) + 0.22 * fractal_noise(uv, {24, 24}, 4, 13) - 0.02;
}

Spot metal_spot(Point uv, double depth) {
  const double blotch = fractal_noise(warped(uv, {6, 6}, 0.03, 21), {6, 6}, 5, 22);
  const double rolled = gradient_noise(uv, {4, 96}, 23);
  const double scaled = smooth_step(-0.16, 0.08, blotch + 0.10 * rolled);
  const double scratch =
      scratch_depth(uv, {.count = 40, .length = 0.3, .width = 0.0024, .seed = 24});
  const double pit =
      smooth_step(0.22, 0.04,
                  nearest_seed(warped(uv, {20, 20}, 0.006, 26), {52, 52}, 25).distance) *
      smooth_step(0.70, 1.0, nearest_seed(uv, {52, 52}, 25).chance);
  const double bare = std::max(1 - scaled, scratch);
  const double fringe = smooth_step(-0.16, -0.01, depth);  // a brown film runs ahead of the rust

  Spot s;
  s.color = mix(scale * (1 + 0.35 * rolled), iron * (1 + 0.08 * rolled), bare);
  s.metallic = bare;
  s.roughness = mix(0.52 + 0.08 * rolled, 0.30 + 0.10 * rolled - 0.08 * scratch, bare);
  s.color = mix(s.color, red_rust * 0.55, 0.75 * fringe + 0.8 * pit * (1 - fringe));
  s.metallic *= (1 - 0.85 * fringe) * (1 - 0.9 * pit);
  s.roughness = mix(s.roughness, 0.72, 0.8 * std::max(fringe, pit));
  s.height = 0.42 + 0.035 * scaled + 0.012 * rolled - 0.05 * scratch - 0.09 * pit;
  return s;
}

Spot rust_spot(Point uv, double depth) {
  const double grain = fractal_noise(uv, {48, 48}, 4, 31);
  const double clump = fractal_noise(warped(uv, {10, 10}, 0.02, 32), {10, 10}, 5, 33);
  const double crust = creased_noise(warped(uv, {8, 8}, 0.02, 34), {12, 12}, 4, 35);
  const double old = smooth_step(0.10, 0.55, depth + 0.30 * clump);
  const double young = smooth_step(0.05, 0.60, clump + 0.55 * grain - 0.25 * old);

  Spot s;
  s.color = mix(red_rust, deep_rust, old);
  s.color = mix(s.color, young_rust, young);
  s.color = s.color * (1 + 0.40 * grain + 0.45 * (crust - 0.3));
  s.metallic = 0;
  s.roughness = 0.86 + 0.08 * grain - 0.20 * old * smooth_step(0.35, 0.10, crust);
  const double swollen = smooth_step(0.0, 0.16, depth);
  s.height = 0.44 + 0.16 * swollen + 0.22 * swollen * (crust - 0.35) + 0.08 * clump + 0.07 * grain;
  return s;
}

Spot spot(Point uv) {
  const double depth = rust_depth(uv);
  const double rusted = smooth_step(-0.012, 0.030, depth);
  const Spot a = metal_spot(uv, depth), b = rust_spot(uv, depth);
  return {.color = mix(a.color, b.color, rusted),
          .specular = {},
          .level = 0.5,
          .roughness = mix(a.roughness, b.roughness, rusted),
          .metallic = mix(a.metallic, b.metallic, rusted),
          .height = mix(a.height, b.height, rusted)};
}

}  // namespace

Set rusted_iron() {
  return {.folder = "rusted_iron",
          .spot = spot,
          .relief = 9,
          .files = {{"rusted_iron_basecolor.png", Map::Albedo},
                    {"rusted_iron_occlusionRoughnessMetallic.png", Map::OcclusionRoughnessMetallic},
                    {"rusted_iron_normal_dx.png", Map::NormalDirectX}}};
}

}  // namespace kiln::textures

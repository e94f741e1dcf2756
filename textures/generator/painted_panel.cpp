// SPDX-License-Identifier: Apache-2.0
// Two coats of enamel over primer over brass, chipped at the edges of old blows.
#include <algorithm>
#include <cmath>

#include "surface.h"

namespace kiln::textures {
namespace {

/// Diffuse and specular as the specular-glossiness workflow tells them: a metal has no diffuse.
struct Coat {
  Color diffuse;
  Color specular;
  double roughness;
};
const Coat red{{0.390, 0.026, 0.018}, {0.046, 0.046, 0.046}, 0.22};
const Coat cream{{0.640, 0.560, 0.410}, {0.050, 0.050, 0.050}, 0.26};
const Coat primer{{0.195, 0.205, 0.200}, {0.034, 0.034, 0.034}, 0.78};
const Coat brass{{0.006, 0.004, 0.002}, {0.760, 0.565, 0.245}, 0.27};
const Coat tarnish{{0.050, 0.034, 0.016}, {0.300, 0.185, 0.075}, 0.55};

Coat blend(const Coat& a, const Coat& b, double t) {
  return {mix(a.diffuse, b.diffuse, t), mix(a.specular, b.specular, t),
          mix(a.roughness, b.roughness, t)};
}

/// A cream band with a pinstripe on either side, painted over the red.
double band(Point uv) {
  const double v = wrap(uv.y) + 0.0012 * fractal_noise(uv, {12, 12}, 3, 3);
  const auto stripe = [&](double centre, double half) {
    return smooth_step(half + 0.0015, half - 0.0015, std::abs(v - centre));
  };
  return std::max({stripe(0.5, 0.115), stripe(0.348, 0.010), stripe(0.652, 0.010)});
}

/// How deep a blow went: 0 the paint holds, 1 down to the brass.
double damage(Point uv) {
  const Point torn = warped(warped(uv, {10, 10}, 0.016, 11), {40, 40}, 0.006, 17);
  const double field = fractal_noise(warped(uv, {3, 3}, 0.06, 12), {3, 3}, 4, 13);
  const double flakes = nearest_seed(torn, {18, 18}, 14).chance - 0.5;
  const double crumbs = nearest_seed(torn, {56, 56}, 15).chance - 0.5;
  const double scratch = scratch_depth(torn, {.count = 16,
                                              .length = 0.45,
                                              .width = 0.006,
                                              .angle_rad = 0.7,
                                              .spread_rad = 2.0,
                                              .seed = 16});
  return field + 0.26 * flakes + 0.16 * crumbs + 0.42 * scratch;
}

Coat metal(Point uv) {
  const double brushed = gradient_noise(uv, {160, 5}, 21);
  const double aged =
      smooth_step(-0.15, 0.45, fractal_noise(warped(uv, {6, 6}, 0.04, 22), {6, 6}, 5, 23));
  Coat coat = blend(brass, tarnish, 0.75 * aged);
  coat.roughness += 0.06 * brushed;
  coat.specular = coat.specular * (1 + 0.08 * brushed);
  return coat;
}

Coat enamel(Point uv, double depth) {
  Coat coat = blend(red, cream, band(uv));
  const double faded = smooth_step(-0.1, 0.6, fractal_noise(uv, {2, 2}, 4, 31));
  const double dusty =
      smooth_step(0.0, 0.5, fractal_noise(warped(uv, {5, 5}, 0.05, 32), {4, 4}, 6, 33));
  const double dirty = smooth_step(0.02, 0.32, depth);  // grime gathers around old chips
  coat.diffuse = mix(coat.diffuse, coat.diffuse * 0.75 + Color{0.07, 0.06, 0.055}, 0.5 * faded);
  coat.diffuse = mix(coat.diffuse, {0.050, 0.038, 0.028}, 0.45 * dirty);
  coat.roughness += 0.10 * faded + 0.26 * dusty + 0.22 * dirty;
  coat.specular = coat.specular * (1 - 0.25 * dusty);
  return coat;
}

Spot spot(Point uv) {
  const double depth = damage(uv);
  const double chipped = smooth_step(0.395, 0.415, depth), bare = smooth_step(0.465, 0.490, depth);
  const double peel = fractal_noise(uv, {40, 40}, 2, 41);
  const Coat coat = blend(blend(enamel(uv, depth), primer, chipped), metal(uv), bare);

  Spot s;
  s.color = coat.diffuse;
  s.specular = coat.specular;
  s.roughness = coat.roughness + 0.03 * peel;
  const double lifted =
      smooth_step(0.34, 0.395, depth) * (1 - chipped);  // paint curls before it goes
  s.height = 0.70 + 0.030 * peel * (1 - bare) + 0.05 * band(uv) * (1 - chipped) + 0.07 * lifted -
             0.20 * chipped - 0.18 * bare + 0.02 * bare * gradient_noise(uv, {160, 5}, 21);
  return s;
}

}  // namespace

Set painted_panel() {
  return {.folder = "painted_panel",
          .spot = spot,
          .relief = 5,
          .files = {{"painted_panel_diffuse.png", Map::Albedo},
                    {"painted_panel_specular.png", Map::SpecularColor},
                    {"painted_panel_glossiness.png", Map::Glossiness},
                    {"painted_panel_normal.png", Map::NormalOpenGl},
                    {"painted_panel_height.png", Map::Height}}};
}

}  // namespace kiln::textures

// SPDX-License-Identifier: Apache-2.0
// Herringbone twill of indigo wool and raw silk, with bands of metal-wound thread.
#include <algorithm>
#include <array>
#include <cmath>

#include "surface.h"

namespace kiln::textures {
namespace {

constexpr int threads = 64;  ///< across the tile, both ways; warp goes down, weft goes across
constexpr int bone = 16;     ///< threads after which the twill turns

struct Yarn {
  Color albedo;
  Color specular;
  double roughness;
};
const Yarn indigo{{0.022, 0.035, 0.105}, {0.040, 0.042, 0.048}, 0.80};
const Yarn silk{{0.480, 0.415, 0.300}, {0.088, 0.080, 0.066}, 0.46};
const Yarn madder{{0.230, 0.030, 0.022}, {0.046, 0.042, 0.042}, 0.76};
const Yarn gold{{0.050, 0.030, 0.010}, {0.720, 0.520, 0.230}, 0.36};

const Yarn& warp_yarn(int i) {
  const int of_stripe = i % 32;
  if (of_stripe == 5 || of_stripe == 27) return madder;
  return of_stripe >= 14 && of_stripe < 18 ? silk : indigo;
}

const Yarn& weft_yarn(int i) {
  const int of_stripe = i % 32;
  if (of_stripe >= 13 && of_stripe < 18 && of_stripe != 15) return gold;
  return of_stripe % 8 == 3 ? madder : of_stripe >= 12 && of_stripe < 19 ? indigo : silk;
}

/// Twill 2/2 that turns every `bone` warp threads: does the warp lie on top here?
bool warp_on_top(int warp, int weft) {
  const int turned = (warp / bone) % 2 == 0 ? warp % bone : bone - 1 - warp % bone;
  return ((turned + weft) % 4 + 4) % 4 < 2;
}

/// One thread at a point: `across` in [-1,1] over its width, `along` in threads.
struct Pass {
  double round;  ///< profile of the thread [0..1]
  double twist;  ///< its plies [-1..1]
  double fuzz;
};

Pass pass(double across, double along, double own) {
  const double round = std::sqrt(std::max(1 - across * across, 0.0));
  const double twist = std::sin(2 * pi * (along * 1.0 + 0.55 * across + own));
  return {round, twist, own};
}

Spot yarn_spot(const Yarn& yarn, const Pass& p, double lift, double wear) {
  Spot s;
  const double shade = 0.55 + 0.45 * p.round + 0.10 * p.twist;
  s.color = yarn.albedo * (shade * (0.82 + 0.36 * p.fuzz));
  s.color = mix(s.color, s.color * 0.7 + Color{0.030, 0.028, 0.026}, 0.6 * wear);
  s.specular = yarn.specular * (0.80 + 0.20 * p.round) * (1 - 0.35 * wear);
  s.roughness = yarn.roughness + 0.05 * p.twist + 0.10 * wear;
  s.height = 0.15 + 0.55 * lift * p.round + 0.15 * p.round + 0.05 * p.twist * p.round;
  return s;
}

Spot spot(Point uv) {
  const Point bent = warped(uv, {8, 8}, 0.0012, 5);
  const double px = wrap(bent.x) * threads, py = wrap(bent.y) * threads;
  const int warp = static_cast<int>(px) % threads, weft = static_cast<int>(py) % threads;
  const double fx = px - std::floor(px), fy = py - std::floor(py);
  const double wear =
      smooth_step(0.05, 0.55, fractal_noise(warped(uv, {3, 3}, 0.06, 7), {3, 3}, 5, 8));
  const double fuzz = 0.5 + 0.5 * fractal_noise(uv, {128, 128}, 2, 9);

  const bool on_top = warp_on_top(warp, weft);
  const double across = on_top ? 2 * fx - 1 : 2 * fy - 1;
  const double own = on_top ? chance(warp, 0, 21) : chance(weft, 1, 21);
  Pass p = pass(across, on_top ? py : px, own);
  p.fuzz = 0.5 * own + 0.5 * fuzz;
  // A float rises in its middle and dives under where the next thread takes over.
  const double along = on_top ? fy : fx;
  const bool before = on_top ? warp_on_top(warp, weft - 1) : !warp_on_top(warp - 1, weft);
  const bool after = on_top ? warp_on_top(warp, weft + 1) : !warp_on_top(warp + 1, weft);
  const double lift =
      (before ? 1 : smooth_step(-0.05, 0.55, along)) * (after ? 1 : smooth_step(1.05, 0.45, along));
  const Yarn& yarn = on_top ? warp_yarn(warp) : weft_yarn(weft);
  Spot s = yarn_spot(yarn, p, lift, &yarn == &gold ? 0.3 * wear : wear);
  s.color = s.color * (0.55 + 0.45 * lift);
  return s;
}

}  // namespace

Set woven_fabric() {
  return {.folder = "woven_fabric",
          .spot = spot,
          .relief = 3.5,
          .files = {{"woven_fabric_albedo.png", Map::Albedo},
                    {"woven_fabric_specular.png", Map::SpecularColor},
                    {"woven_fabric_roughness.png", Map::Roughness},
                    {"woven_fabric_normal.png", Map::NormalOpenGl},
                    {"woven_fabric_height.png", Map::Height}}};
}

}  // namespace kiln::textures

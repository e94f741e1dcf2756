// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "kiln/math/vec.h"

namespace kiln::textures {

using Point = Vec2<double>;
using Color = Vec3<double>;  ///< linear Rec.709

/// How many cells of a lattice fill the tile, across and down. Everything below repeats with it.
struct Cells {
  int x = 1;
  int y = 1;
};

/// A number in [0,1) that belongs to a lattice point.
double chance(int x, int y, std::uint32_t seed);

/// Gradient noise over the tile [0,1)^2, without a seam at its borders.
/// @return about [-1,1], mean 0
double gradient_noise(Point uv, Cells cells, std::uint32_t seed);

/// Octaves of gradient noise, each twice as fine and half as strong as the one before.
/// @return about [-1,1], mean 0
double fractal_noise(Point uv, Cells cells, int octaves, std::uint32_t seed);

/// Octaves of |noise|: creases at 0, ridges at 1.
/// @return [0,1]
double creased_noise(Point uv, Cells cells, int octaves, std::uint32_t seed);

/// Where a point lies among scattered seeds, one per cell, without a seam.
struct Nearest {
  double distance;   ///< to the nearest seed [cell]
  double to_border;  ///< to the border between the two nearest seeds, roughly [cell]
  double chance;     ///< a number in [0,1) that belongs to the nearest seed
};
Nearest nearest_seed(Point uv, Cells cells, std::uint32_t seed);

/// Depth of `count` straight scratches scattered over the tile.
struct Scratches {
  int count = 20;
  double length = 0.2;     ///< longest [tile]
  double width = 0.002;    ///< [tile]
  double angle_rad = 0.0;  ///< mean direction, counter-clockwise from +x
  double spread_rad = 3.2;
  std::uint32_t seed = 0;
};
/// @return [0,1], 0 away from every scratch
double scratch_depth(Point uv, const Scratches& scratches);

/// The point moved by noise, so that shapes drawn there look grown and not drawn.
Point warped(Point uv, Cells cells, double amount, std::uint32_t seed);

/// 0 below `low`, 1 above `high`, smooth between; also with low > high.
double smooth_step(double low, double high, double x);

/// a where t = 0, b where t = 1.
double mix(double a, double b, double t);
Color mix(const Color& a, const Color& b, double t);

/// x wrapped into [0,1).
double wrap(double x);

}  // namespace kiln::textures

// SPDX-License-Identifier: Apache-2.0
#include "noise.h"

#include <algorithm>
#include <cmath>

#include "kiln/math/hash.h"

namespace kiln::textures {
namespace {

int wrapped(int i, int period) { return ((i % period) + period) % period; }

/// Weight with vanishing first and second derivative at both ends.
double fade(double t) { return t * t * t * (t * (t * 6 - 15) + 10); }

double slope_at(int x, int y, Cells cells, std::uint32_t seed, Point offset) {
  const double angle = 2 * pi * chance(wrapped(x, cells.x), wrapped(y, cells.y), seed);
  return std::cos(angle) * offset.x + std::sin(angle) * offset.y;
}

/// Difference of two coordinates on the tile, the short way round.
double across(double a, double b) {
  const double d = a - b;
  return d - std::round(d);
}

}  // namespace

double chance(int x, int y, std::uint32_t seed) {
  const std::uint32_t row = combine_hash<std::uint32_t>(seed, static_cast<std::uint32_t>(y));
  return combine_hash<std::uint32_t>(row, static_cast<std::uint32_t>(x)) * 0x1p-32;
}

double gradient_noise(Point uv, Cells cells, std::uint32_t seed) {
  const double px = uv.x * cells.x, py = uv.y * cells.y;
  const int x = static_cast<int>(std::floor(px)), y = static_cast<int>(std::floor(py));
  const double fx = px - x, fy = py - y;
  const double top = mix(slope_at(x, y, cells, seed, {fx, fy}),
                         slope_at(x + 1, y, cells, seed, {fx - 1, fy}), fade(fx));
  const double bottom = mix(slope_at(x, y + 1, cells, seed, {fx, fy - 1}),
                            slope_at(x + 1, y + 1, cells, seed, {fx - 1, fy - 1}), fade(fx));
  return mix(top, bottom, fade(fy)) * 1.4142135623730951;
}

double fractal_noise(Point uv, Cells cells, int octaves, std::uint32_t seed) {
  double sum = 0, weight = 0, strength = 1;
  for (int i = 0; i < octaves; ++i) {
    sum += strength * gradient_noise(uv, cells, seed + static_cast<std::uint32_t>(i));
    weight += strength;
    strength *= 0.5;
    cells = {cells.x * 2, cells.y * 2};
  }
  return sum / weight * 1.3;
}

double creased_noise(Point uv, Cells cells, int octaves, std::uint32_t seed) {
  double sum = 0, weight = 0, strength = 1;
  for (int i = 0; i < octaves; ++i) {
    sum += strength * std::abs(gradient_noise(uv, cells, seed + static_cast<std::uint32_t>(i)));
    weight += strength;
    strength *= 0.5;
    cells = {cells.x * 2, cells.y * 2};
  }
  return std::clamp(sum / weight, 0.0, 1.0);
}

Nearest nearest_seed(Point uv, Cells cells, std::uint32_t seed) {
  const double px = uv.x * cells.x, py = uv.y * cells.y;
  const int x0 = static_cast<int>(std::floor(px)), y0 = static_cast<int>(std::floor(py));
  double first = 1e9, second = 1e9, owner = 0;
  for (int y = y0 - 2; y <= y0 + 2; ++y) {
    for (int x = x0 - 2; x <= x0 + 2; ++x) {
      const int cx = wrapped(x, cells.x), cy = wrapped(y, cells.y);
      const double dx = x + chance(cx, cy, seed) - px, dy = y + chance(cx, cy, seed + 1) - py;
      const double distance = std::sqrt(dx * dx + dy * dy);
      if (distance < first) {
        second = first;
        first = distance;
        owner = chance(cx, cy, seed + 2);
      } else {
        second = std::min(second, distance);
      }
    }
  }
  return {first, (second - first) / 2, owner};
}

double scratch_depth(Point uv, const Scratches& scratches) {
  double depth = 0;
  for (int i = 0; i < scratches.count; ++i) {
    const auto draw = [&](int what) { return chance(i, what, scratches.seed); };
    const double angle = scratches.angle_rad + (draw(0) - 0.5) * scratches.spread_rad;
    const double reach = scratches.length * (0.2 + 0.8 * draw(1)) / 2;
    const double dx = across(uv.x, draw(2)), dy = across(uv.y, draw(3));
    const double along = dx * std::cos(angle) - dy * std::sin(angle);
    const double aside = dx * std::sin(angle) + dy * std::cos(angle);
    const double bow = aside + 0.16 * (draw(4) - 0.5) * along * along / reach;
    const double body = smooth_step(scratches.width, 0.0, std::abs(bow));
    depth = std::max(
        depth, body * smooth_step(reach, 0.4 * reach, std::abs(along)) * (0.3 + 0.7 * draw(5)));
  }
  return depth;
}

Point warped(Point uv, Cells cells, double amount, std::uint32_t seed) {
  return {uv.x + amount * fractal_noise(uv, cells, 4, seed),
          uv.y + amount * fractal_noise(uv, cells, 4, seed + 101)};
}

double smooth_step(double low, double high, double x) {
  const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

double mix(double a, double b, double t) { return a + (b - a) * t; }

Color mix(const Color& a, const Color& b, double t) { return a * (1 - t) + b * t; }

double wrap(double x) { return x - std::floor(x); }

}  // namespace kiln::textures

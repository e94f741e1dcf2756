// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "kiln/image/resample.h"
#include "kiln/material/normals.h"

namespace kiln {
namespace {

// The convention of correlations with height and with the gradient's sign.
NormalConvention decide(const Correlation& x, const Correlation& y) {
  if (!y.significant()) return NormalConvention::Auto;
  const bool is_depth = x.significant() && x.value() > 0;
  const bool up = (y.value() > 0) != is_depth;
  return up ? NormalConvention::OpenGl : NormalConvention::DirectX;
}

}  // namespace

void Correlation::add(double x, double y) {
  n += 1;
  a += x;
  b += y;
  aa += x * x;
  bb += y * y;
  ab += x * y;
}

double Correlation::value() const {
  const double spread = (n * aa - a * a) * (n * bb - b * b);
  return spread > 0 ? (n * ab - a * b) / std::sqrt(spread) : 0.0;
}

bool Correlation::significant() const {
  return n > 0 && std::abs(value()) > std::max(0.1, 4 / std::sqrt(n));
}

void ConventionEvidence::add(const std::array<Plane, 3>& normal, const Plane& height) {
  const Size size = normal[0].size();
  for (int row = 1; row + 1 < size.height; ++row) {
    const float* above = height.row(row - 1);
    const float* here = height.row(row);
    const float* below = height.row(row + 1);
    for (int i = 1; i + 1 < size.width; ++i) {
      const float dx = here[i + 1] - here[i - 1];
      const float dy = below[i] - above[i];
      if (!std::isfinite(dx) || !std::isfinite(dy)) continue;
      x_.add(normal[0].at(i, row), dx);
      y_.add(normal[1].at(i, row), dy);
    }
  }
}

void ConventionEvidence::add(const std::array<Plane, 3>& normal) {
  const Size size = normal[0].size();
  const auto slope = [&](int component, int i, int row) {
    return normal[component].at(i, row) / std::max(normal[2].at(i, row), least_normal_z);
  };
  for (int row = 1; row + 1 < size.height; ++row) {
    for (int i = 1; i + 1 < size.width; ++i) {
      // p = -nx/nz and q = ny/nz, y down the rows.
      const float dp_dy = slope(0, i, row - 1) - slope(0, i, row + 1);
      const float dq_dx = slope(1, i + 1, row) - slope(1, i - 1, row);
      mixed_.add(dp_dy, dq_dx);
    }
  }
}

ConventionGuess ConventionEvidence::by_height() const {
  ConventionGuess guess{decide(x_, y_), x_.value(), y_.value(), {}};
  guess.reason = fmt::format("correlation of nx with dh/dx {:.2f}, of ny with dh/dy {:.2f}",
                             guess.correlation_x, guess.correlation_y);
  if (guess.convention != NormalConvention::Auto && x_.significant() && x_.value() > 0) {
    guess.reason += ", the height map holds depth";
  }
  return guess;
}

ConventionGuess ConventionEvidence::by_slopes() const {
  ConventionGuess guess;
  guess.correlation_x = guess.correlation_y = mixed_.value();
  if (mixed_.significant()) {
    guess.convention = mixed_.value() > 0 ? NormalConvention::OpenGl : NormalConvention::DirectX;
  }
  guess.reason = fmt::format("correlation of the slopes' mixed derivatives {:.2f}", mixed_.value());
  return guess;
}

ConventionGuess guess_convention(const std::array<Plane, 3>& normal, const Plane& height) {
  ConventionEvidence evidence;
  evidence.add(normal, resample(height, normal[0].size()));
  return evidence.by_height();
}

ConventionGuess guess_convention(const std::array<Plane, 3>& normal) {
  ConventionEvidence evidence;
  evidence.add(normal);
  return evidence.by_slopes();
}

}  // namespace kiln

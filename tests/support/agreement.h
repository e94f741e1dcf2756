// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <string_view>

#include "directions.h"

namespace kiln::test {

/// Float rounds its arguments first: the oracle is evaluated at the rounded direction.
inline Vec3<double> rounded(const Vec3<double>& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

/// Expects evaluate.operator()<F>() to be the truth at float, wide float (every lane of it) and
/// wide double.
/// @param tolerance  relative, of the two float types; 1e-6 of it for double
/// @param floor      magnitudes below it count as it
template <class Evaluate>
void expect_alike(double truth, double tolerance, double floor, const Evaluate& evaluate,
                  std::string_view label) {
  const double scale = std::max(std::abs(truth), floor);
  EXPECT_NEAR(evaluate.template operator()<float>(), truth, tolerance * scale) << label;
  float lanes[lane_count<WideFloat>];
  store_lanes(lanes, evaluate.template operator()<WideFloat>());
  for (const float lane : lanes) EXPECT_NEAR(lane, truth, tolerance * scale) << label << " wide";
  double doubles[lane_count<WideDouble>];
  store_lanes(doubles, evaluate.template operator()<WideDouble>());
  const double narrow = std::max(1e-6 * tolerance, 1e-13) * scale;
  for (const double lane : doubles) EXPECT_NEAR(lane, truth, narrow) << label << " wide double";
}

/// n directions whose tangents spread over all scales from a thousandth of the width to a
/// thousand; rounded to float.
inline std::vector<Vec3<double>> lobe_directions(double width, int n) {
  std::vector<Vec3<double>> directions;
  directions.reserve(n + 1);
  for (int i = 0; i < n; ++i) {
    const double tangent = width * std::pow(10.0, -3 + 6 * (i + 0.5) / n);
    directions.push_back(rounded(direction(1 / std::sqrt(1 + tangent * tangent), 2.399963 * i)));
  }
  directions.push_back({0, 0, 1});
  return directions;
}

}  // namespace kiln::test

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>

#include "kiln/math/wide.h"

namespace kiln {

/// Sum over i of term(i) in double, several wide numbers side by side, so that additions need not
/// wait for one another. The order of additions depends on `count` alone.
/// @param wide    of i: terms i, i + 1, ... of a wide number
/// @param scalar  of i: one term
template <class WideTerm, class ScalarTerm>
double sum_of_terms(size_t count, WideTerm wide, ScalarTerm scalar) {
  constexpr size_t lanes = lane_count<WideDouble>, together = 4;
  std::array<WideDouble, together> sums;
  sums.fill(WideDouble(0.0));
  size_t i = 0;
  for (; i + together * lanes <= count; i += together * lanes) {
    for (size_t k = 0; k < together; ++k) sums[k] += wide(i + k * lanes);
  }
  double rest = 0;
  for (; i < count; ++i) rest += scalar(i);
  double lane[lanes];
  store_lanes(lane, (sums[0] + sums[1]) + (sums[2] + sums[3]));
  for (const double sum : lane) rest += sum;
  return rest;
}

inline WideDouble load_as_double(const float* from) { return WideDouble::load_unaligned(from); }

inline double sum_of(std::span<const float> values) {
  const float* v = values.data();
  return sum_of_terms(
      values.size(), [v](size_t i) { return load_as_double(v + i); },
      [v](size_t i) { return static_cast<double>(v[i]); });
}

inline double sum_of_magnitudes(std::span<const float> values) {
  const float* v = values.data();
  return sum_of_terms(
      values.size(), [v](size_t i) { return abs(load_as_double(v + i)); },
      [v](size_t i) { return static_cast<double>(std::abs(v[i])); });
}

/// @param weights  as many as values
inline double weighted_sum(std::span<const float> values, std::span<const double> weights) {
  const float* v = values.data();
  const double* w = weights.data();
  return sum_of_terms(
      values.size(),
      [v, w](size_t i) { return load_as_double(v + i) * load_lanes<WideDouble>(w + i); },
      [v, w](size_t i) { return v[i] * w[i]; });
}

}  // namespace kiln

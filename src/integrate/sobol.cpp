// SPDX-License-Identifier: Apache-2.0
#include "kiln/integrate/sobol.h"

namespace kiln {
namespace {

// A primitive polynomial (degree, inner coefficients) and its initial direction integers.
struct Dimension {
  int degree;
  std::uint32_t coefficients;
  std::array<std::uint32_t, 3> initial;
};

constexpr Dimension later_dimensions[3] = {{1, 0, {1, 0, 0}}, {2, 1, {1, 3, 0}}, {3, 1, {1, 3, 1}}};

using Directions = std::array<std::uint32_t, 32>;

Directions first_directions() {
  Directions v;
  for (int k = 0; k < 32; ++k) v[k] = 1u << (31 - k);
  return v;
}

Directions directions_of(const Dimension& dimension) {
  const int s = dimension.degree;
  Directions v;
  for (int k = 0; k < 32; ++k) {
    if (k < s) {
      v[k] = dimension.initial[k] << (31 - k);
      continue;
    }
    v[k] = v[k - s] ^ (v[k - s] >> s);
    for (int j = 1; j < s; ++j) {
      if ((dimension.coefficients >> (s - 1 - j)) & 1u) v[k] ^= v[k - j];
    }
  }
  return v;
}

}  // namespace

SobolPoints sobol_points_reversed(int n) {
  const std::array<Directions, 4> directions = {
      first_directions(), directions_of(later_dimensions[0]), directions_of(later_dimensions[1]),
      directions_of(later_dimensions[2])};
  SobolPoints points(n);
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(n); ++i) {
    for (int d = 0; d < 4; ++d) {
      std::uint32_t x = 0;
      for (int k = 0; k < 32; ++k) {
        if ((i >> k) & 1u) x ^= directions[d][k];
      }
      points[i][d] = reverse_bits(x);
    }
  }
  return points;
}

}  // namespace kiln

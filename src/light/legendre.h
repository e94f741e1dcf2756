// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "kiln/math/wide.h"

namespace kiln {

// Harmonics of prefiltering: Y_lm = P_lm(cos theta) exp(i m psi), orthonormal over the sphere, with
// theta from +Y and psi = 2 pi u of the lat-long image. The sign convention is of no consequence,
// for each expansion is only ever evaluated by the same functions.

/// The rings of a lat-long grid in pairs that mirror each other, north and south of the equator.
/// The middle ring of an odd number is paired with nothing. Padded to whole wide numbers by the
/// equator.
struct RingPairs {
  explicit RingPairs(int rings);

  int rings = 0;
  int count = 0;                         ///< pairs
  std::vector<WideDouble> sine, cosine;  ///< [blocks] of the northern ring's polar angle

  int blocks() const { return static_cast<int>(sine.size()); }
  bool has_south(int pair) const { return rings - 1 - pair != pair; }
};

/// P_lm for one m and all l from m to `order`, as a recurrence:
///
///     P_l = scale[l - m] cos(theta) P_l-1 - back[l - m] P_l-2,     P_m = seed_factor sin(theta)^m
///
/// Where sin(theta)^m underflows, so does P_lm for every l below 1900.
struct LegendreColumn {
  LegendreColumn(int m, int order);

  int m, order;
  double seed_factor;
  std::vector<double> scale, back;  ///< [order + 1 - m]; the first is unused

  /// P_m of a block of rings.
  WideDouble seed(WideDouble sine) const;

  /// P_l from P_l-1 and P_l-2, with i = l - m.
  WideDouble next(size_t i, WideDouble cosine, WideDouble last, WideDouble before) const {
    return fma(WideDouble(scale[i]) * cosine, last, -(WideDouble(back[i]) * before));
  }

  /// Whether every P_lm with l below `bands` is too small to matter on a block of rings: m exceeds
  /// bands sin(theta) by far.
  bool vanishes_at(const RingPairs& rings, int block, size_t bands) const;

  /// The first block where not all of them vanish.
  int first_block(const RingPairs& rings) const;
};

/// The columns of every m from 0 to `order`.
std::vector<LegendreColumn> legendre_columns(int order);

}  // namespace kiln

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
  int count = 0;                     ///< pairs
  int blocks = 0;                    ///< wide numbers that hold them
  std::vector<double> sine, cosine;  ///< [blocks * lanes] of the northern ring's polar angle

  int padded() const { return static_cast<int>(sine.size()); }
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

  WideDouble seed(const RingPairs& rings, int block) const;

  /// Below this block every P_lm is too small to matter (m exceeds order sin(theta) by far).
  int first_block(const RingPairs& rings) const;
};

}  // namespace kiln

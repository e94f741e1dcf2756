// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "kiln/math/wide.h"

namespace kiln {

/// What a GGX surface seen straight down reflects from the cosine c to its normal, up to a factor:
///
///     K(c) = D(h) G1(c)    if c > 0, else 0,    n.h = sqrt((1 + c) / 2)
///
/// in terms of s = (1 - c) / 2, where nothing cancels at the peak.
/// @param alpha2  alpha squared
/// @source Walter et al. 2007
template <class F>
F straight_lobe(F alpha2, F c, F s) {
  const F base = fma(alpha2, F(1) - s, s);
  const F cosine = max(c, F(0));
  const F slant = sqrt(fma(alpha2, F(1) - cosine * cosine, cosine * cosine));
  return F(2 / pi) * alpha2 * cosine / (base * base * (cosine + slant));
}

}  // namespace kiln

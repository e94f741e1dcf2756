// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "kiln/math/wide.h"

namespace kiln {

/// The GGX lobe of prefiltering under normal = view = direction, up to a factor,
///
///     K(c) = c / ((1 + c)/2 (alpha^2 - 1) + 1)^2   if c > 0, else 0,    c = d.w
///
/// in terms of s = |d - w|^2 / 4, c = 1 - 2 s, where nothing cancels at the peak.
/// @source Walter et al. 2007, eq. 33; Karis 2013, "Real Shading in Unreal Engine 4"
template <class F>
F ggx_lobe(F s, F alpha2) {
  const F base = fma(alpha2, F(1) - s, s);
  return max(fma(F(-2), s, F(1)), F(0)) / (base * base);
}

/// A kernel that depends on the angle alone, as k_l: a convolution multiplies band l by k_l.
struct ZonalKernel {
  double alpha = 0;
  double integral = 0;         ///< of K over the sphere, before k_0 was made 1 [sr]
  std::vector<double> factor;  ///< k_l, [order + 1]; k_0 = 1

  int order() const { return static_cast<int>(factor.size()) - 1; }
};

/// Expands ggx_lobe, and cuts it at the first band beyond which neglected energy,
/// sum (2l + 1) k_l^2, is below cut_off^2 of the whole, or at highest_order.
/// @valid alpha in [1e-3, 1]
ZonalKernel expand_ggx_lobe(double alpha, double cut_off, int highest_order);

}  // namespace kiln

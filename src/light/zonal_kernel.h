// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "kiln/light/prefilter.h"

namespace kiln {

/// A kernel that depends on the angle alone, as k_l: a convolution multiplies band l by k_l.
struct ZonalKernel {
  double integral = 0;         ///< of K over the sphere, before k_0 was made 1 [sr]
  std::vector<double> factor;  ///< k_l, [order + 1]; k_0 = 1

  int order() const { return static_cast<int>(factor.size()) - 1; }
};

/// Expands a lobe (lobe_at), and cuts it at the first band beyond which neglected energy,
/// sum (2l + 1) k_l^2, is below cut_off^2 of the whole, or at highest_order.
/// @valid alpha in [1e-3, 1]
ZonalKernel expand_lobe(const FilterLobe& lobe, double cut_off, int highest_order);

}  // namespace kiln

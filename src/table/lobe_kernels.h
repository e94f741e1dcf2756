// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "kiln/table/lobe.h"
#include "slope_quadrature.h"

namespace kiln {

struct LobeKernels {
  LobeKernel integrate = nullptr;
  /// The limit of zero width, a mirror behind the masking; null for lobes that have none.
  void (*mirror)(const ViewRule& view, double shape, const FresnelStage& stage,
                 Wide* sums) = nullptr;
  double kinked_below = 0;  ///< n.v under which the integrand has kinks, as the masking says
};

/// The kernels of a listed pair of distribution and masking.
/// @error Fault::Usage for names that are unknown or do not fit each other
LobeKernels find_lobe_kernels(const std::string& distribution, const std::string& masking);

/// The shape asked for, or the distribution's default for 0.
/// @error Fault::Usage outside the model's range, or for a model that has none
double shape_of(const std::string& distribution, double shape);

/// The stage of a listed Fresnel model; for the empty name the one of Schlick's terms apart.
/// @error Fault::Usage for unknown names
decltype(FresnelStage::add) find_fresnel_stage(const std::string& name);

}  // namespace kiln

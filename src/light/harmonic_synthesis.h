// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "harmonic_analysis.h"
#include "sphere_field.h"
#include "zonal_kernel.h"

namespace kiln {

/// The convolution of an expansion with a kernel, on a grid fine enough for 8 x 8 interpolation:
/// three colours, and as the fourth value the same convolution of the constant 1 as point masses.
/// @param columns  those of the expansion
/// @valid kernel.order() <= expansion.order
SphereField convolve(const Expansion& expansion, const std::vector<LegendreColumn>& columns,
                     const ZonalKernel& kernel);

}  // namespace kiln

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "kiln/table/lobe.h"

namespace kiln {

// The lobe that previews use and most engines assume: GGX with height-correlated Smith masking.

/// Its split-sum terms: `scale` + `bias` = E, the albedo with F = 1, and F0 * scale + F90 * bias
/// with Schlick's Fresnel.
/// @valid   mu and alpha in [1e-4, 1]
/// @source  derived in docs/quadrature.md
SplitSumTerms<double> integrate_split_sum(double mu, double alpha,
                                          Quality quality = Quality::Table);

/// Cosine-weighted average over directions, 2 INT_0^1 E(mu) mu dmu.
SplitSumTerms<double> integrate_average(double alpha);

}  // namespace kiln

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "kiln/brdf/energy.h"

namespace kiln {

/// A specular lobe by the names of its models.
struct Lobe {
  std::string distribution = "ggx";
  std::string masking = "smith-correlated";
  double shape = 0;  ///< of distributions that have one; 0 is the model's default
};

/// How far a quadrature goes: errors about 1e-6, or 1e-10.
enum class Quality { Table, Exact };

/// Split-sum terms on a grid of directions and widths, [alpha][mu]: `scale` + `bias` = E, the
/// albedo with F = 1, and F0 * scale + F90 * bias with Schlick's Fresnel.
///
/// Large grids of smooth lobes are interpolated between Chebyshev nodes, which costs less than an
/// integral an entry and keeps the accuracy.
///
/// @valid mus in [1e-4, 1], alphas in [1e-4, 1]; clamped
/// @error Fault::Usage for names that are not on the lists or do not fit each other
std::vector<SplitSumTerms<double>> integrate_grid(const Lobe& lobe, std::span<const double> mus,
                                                  std::span<const double> alphas, Quality quality);

}  // namespace kiln

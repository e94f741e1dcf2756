// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "kiln/material/svbrdf.h"

namespace kiln {

/// Fills roughness, anisotropy and angle of `half`, of which `svbrdf` is twice the size.
///
/// Facets of an anisotropic lobe have slopes of covariance Sigma = R diag(alpha_x^2, alpha_y^2) R^T
/// / 2 (Beckmann), R turning by the angle, and over a footprint covariances average. The axes of
/// the mean and its eigenvalues are the new angle and widths.
void halve_anisotropic(const Svbrdf& svbrdf, Svbrdf& half);

}  // namespace kiln

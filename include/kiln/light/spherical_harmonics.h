// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "kiln/image/layers.h"
#include "kiln/math/vec.h"

namespace kiln {

/// A function of direction as a sum of real spherical harmonics, without the Condon-Shortley sign,
/// polar axis +Z: L1-1 ~ y, L10 ~ z, L11 ~ x. Coefficient (l, m) is at l * l + l + m.
struct SphericalHarmonics {
  int order = 0;
  std::vector<Vec3<double>> coefficients;  ///< [(order + 1)^2]
};

/// Values of all harmonics up to `order` at the unit direction d: [(order + 1)^2].
/// @valid     order >= 0
/// @accuracy  1e-13 up to order 32
std::vector<double> harmonics_at(int order, const Vec3<double>& d);

/// L_lm = integral of L Y_lm over the sphere, summed over texel centres with exact solid angles.
/// @param latlong  planes R G B (or one plane, grey), values at texel centres
SphericalHarmonics project_sh(const Layers& latlong, int order);

/// The expansion of irradiance over pi, from that of radiance: each band times A_l / pi.
/// @source Ramamoorthi and Hanrahan 2001, "An Efficient Representation for Irradiance
///         Environment Maps", eq. 8 and 9
SphericalHarmonics irradiance_over_pi(const SphericalHarmonics& radiance);

Vec3<double> evaluate(const SphericalHarmonics& sum, const Vec3<double>& d);

}  // namespace kiln

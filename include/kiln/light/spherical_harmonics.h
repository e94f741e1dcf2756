// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "kiln/image/layers.h"
#include "kiln/light/axes.h"
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
/// @param axes        of the harmonics; those of kiln unless stated
/// @param rotate_deg  of the environment, as of Environment [degree]
/// @accuracy  1e-12 of L_00
SphericalHarmonics project_sh(const Layers& latlong, int order, const Axes& axes = {},
                              double rotate_deg = 0);

/// The expansion of irradiance over pi, from that of radiance: each band times A_l / pi.
/// @source Ramamoorthi and Hanrahan 2001, "An Efficient Representation for Irradiance
///         Environment Maps", eq. 8 and 9
SphericalHarmonics irradiance_over_pi(const SphericalHarmonics& radiance);

/// The mean over the sphere of what is expanded: band 0 is as exact as the sum over texels.
Vec3<double> mean_of(const SphericalHarmonics& sum);

/// The bands up to that order, which the sum has.
SphericalHarmonics up_to(int order, const SphericalHarmonics& sum);

/// What tames the ringing of a sun: band l is damped,
/// Hann by (1 + cos(pi l / w)) / 2, Lanczos by sin(pi l / w) / (pi l / w), with w = order + 1.
enum class ShWindow { None, Hann, Lanczos };
inline constexpr std::array<std::string_view, 3> sh_window_names = {"none", "hann", "lanczos"};
SphericalHarmonics windowed(const SphericalHarmonics& sum, ShWindow window);

/// The nine coefficients up to order 2, with the constants of the harmonics multiplied in, so that
/// a shader sums
///
///     c0 + c1 y + c2 z + c3 x + c4 x y + c5 y z + c6 (3 z^2 - 1) + c7 x z + c8 (x^2 - y^2)
///
/// @valid     order >= 2
std::array<Vec3<double>, 9> scaled_for_shaders(const SphericalHarmonics& sum);

Vec3<double> evaluate(const SphericalHarmonics& sum, const Vec3<double>& d);

}  // namespace kiln

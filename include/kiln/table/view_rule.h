// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

namespace kiln {

/// How many points a quadrature takes: azimuths (over a half circle) and slopes.
struct QuadratureOrder {
  int azimuths = 32;
  int slopes = 40;
};

/// The part of the quadrature of a lobe that depends on the view direction alone.
///
/// In slope polar coordinates around the normal (azimuth p from the view's, t = tan theta_h,
/// tau = tan theta_o) the reflected direction is above the horizon exactly inside the disc
/// t^2 - 2 t tau cos p < 1, so the visibility step becomes a limit of integration,
///
///     E(mu) = INT_0^2pi dp INT_0^tmax(p) D cos^4 t (1 + t tau cos p) G2 F dt,   tmax = e^s,
///     s = asinh(tau cos p) = S cos psi,   S = asinh tau
///
/// and the integrand is analytic and periodic in psi: the midpoint rule converges geometrically.
struct ViewRule {
  double mu = 1, sine = 0, tau = 0;
  /// [azimuths] over the half circle 0 < p < pi, padded to whole vectors by weight 0. The weights
  /// count both half circles, for a lobe that is symmetric about the view's plane.
  std::vector<double> cos_p, sin_p, t_max, weight;
};

/// @param mu  [1e-4, 1]; smaller cosines are clamped
ViewRule make_view_rule(double mu, int azimuths);

inline constexpr double least_mu = 1e-4;

}  // namespace kiln

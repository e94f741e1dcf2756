// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "kiln/brdf/energy.h"

namespace kiln {

/// How many points the quadrature takes: azimuths and slopes.
struct QuadratureOrder {
  int azimuths = 20;
  int slopes = 28;
};

/// Good to 1e-6, absolute, for E, A and B at every alpha in [1e-4, 1]; fewer azimuths where the
/// view is steep, for the integrand is smooth there.
QuadratureOrder table_order(double mu);
/// Good to about 1e-11.
inline constexpr QuadratureOrder reference_order{96, 128};

/// The part of the quadrature that depends on the view direction alone.
///
/// In slope polar coordinates around the normal (azimuth p from the view's, t = tan theta_h,
/// tau = tan theta_o) the reflected direction is above the horizon exactly inside the disc
/// t^2 - 2 t tau cos p < 1, so the visibility step becomes a limit of integration,
///
///     E(mu) = INT_0^2pi dp INT_0^tmax(p) P22(t) t (1 + t tau cos p) G2 F dt,   tmax = e^s,
///     s = asinh(tau cos p) = S cos psi,   S = asinh tau
///
/// and the integrand is analytic and periodic in psi: the midpoint rule converges geometrically.
struct ViewRule {
  double mu = 1, sine = 0, tau = 0;
  std::vector<double> cos_p, t_max, weight;  ///< [azimuths], padded to whole vectors by weight 0
};
ViewRule make_view_rule(double mu, int azimuths);

/// Split-sum terms of GGX with height-correlated Smith masking: `scale` + `bias` = E, the albedo
/// with F = 1, and F0 * scale + F90 * bias with Schlick's Fresnel.
///
/// @param rule   made for mu in [1e-4, 1]; smaller cosines are clamped
/// @param alpha  [1e-4, 1]
/// @source       derived in docs/quadrature.md
SplitSumTerms<double> integrate_split_sum(const ViewRule& rule, double alpha, int slopes);

/// The same with the order for tables, or with that given.
SplitSumTerms<double> integrate_split_sum(double mu, double alpha);
SplitSumTerms<double> integrate_split_sum(double mu, double alpha, QuadratureOrder order);

/// Cosine-weighted average over directions, 2 INT_0^1 E(mu) mu dmu.
SplitSumTerms<double> integrate_average(double alpha);

}  // namespace kiln

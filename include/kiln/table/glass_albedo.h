// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "kiln/table/directional_albedo.h"

namespace kiln {

/// Shares of the energy arriving along wo that a rough dielectric reflects and lets through after
/// a single bounce; both are energies, so the sum is at most 1.
struct GlassTerms {
  double reflected = 0, transmitted = 0;
  /// What refraction sends through a facet and yet back to the side it came from. It is lost; a
  /// sampler that does not look at the side counts it as transmitted. 0 where eta > 1.
  double strayed = 0;

  double total() const { return reflected + transmitted; }
};

/// For tables, good to 1e-6 for mu >= 1e-3 and 3e-6 below: of each ring `azimuths` points, and
/// `slopes` rings between two edges.
inline constexpr QuadratureOrder glass_order{24, 24};
/// Good to about 1e-10.
inline constexpr QuadratureOrder glass_reference_order{96, 96};

/// Albedos of GGX with height-correlated Smith masking and the exact Fresnel reflectance.
///
/// Facet normals m are taken in rings of equal angle theta around wo, where the reflectance and the
/// refraction are constant. On a ring the directions above (reflected) or below (refracted) the
/// surface are an interval of azimuths, and the number of its ends changes only at the edges
///
///     reflected    (pi/2 - theta_o) / 2,   the critical angle,   (pi/2 + theta_o) / 2
///     refracted    theta_t - theta = pi/2 - theta_o,   pi/2 - theta_o,   the critical angle
///
/// with sin(theta_t) = sin(theta) / eta. Between them all is analytic but for roots at the ends,
/// which s^2 (3 - 2 s) removes; sinh removes the peak of the distribution, at theta = theta_o.
///
/// @param eta  refractive index behind the surface over that in front: above 1 light enters, below
///             1 it leaves
/// @valid      mu in [1e-4, 1], alpha in [1e-8, 1]; clamped. eta in [1/1000, 1000]
/// @source     Walter et al. 2007 (the model); the rings are this project's own
GlassTerms integrate_glass(double mu, double alpha, double eta,
                           QuadratureOrder order = glass_order);

/// Cosine-weighted average over directions, 2 INT_0^1 E(mu) mu dmu.
GlassTerms integrate_glass_average(double alpha, double eta, QuadratureOrder order = glass_order);

}  // namespace kiln

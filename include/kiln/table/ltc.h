// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

#include "kiln/core/size.h"
#include "kiln/math/vec.h"

namespace kiln {

/// A lobe to be fitted: f(wo, wi) (n.wi) at the width alpha, both directions above the surface,
/// the same on both sides of the plane of wo and the normal.
using LtcLobe = std::function<double(double alpha, const Vec3<double>& wo, const Vec3<double>& wi)>;

/// GGX with height-correlated Smith masking and F = 1.
LtcLobe ggx_ltc_lobe();

/// The inverse of the matrix that turns the clamped cosine into a lobe seen from wo = (sin, 0, mu),
///
///     M^-1 = [[m11, 0, m13], [0, 1, 0], [m31, 0, m33]],
///     D(w) = max(0, q.z) det(M^-1) / (pi |q|^4),   q = M^-1 w,   INT D dw = 1
///
/// scaled so that its middle is 1. Published tables hold {m11, m31, m13, m33} as R, G, B, A, the
/// columns of M^-1 one after the other.
struct LtcCell {
  double m11 = 1, m31 = 0, m13 = 0, m33 = 1;
  double error = 0;  ///< half of INT |f cos / E - D| dw: the share of light that goes elsewhere

  double determinant() const { return m11 * m33 - m13 * m31; }
};

/// The fitted cosine lobe's density. @return [1/sr]; integrates to 1 over all directions
double ltc_density(const LtcCell& cell, const Vec3<double>& w);

/// Distances of a cosine lobe from f cos / E over the sphere, by the fit's quadrature at a higher
/// order.
struct LtcErrors {
  double l1 = 0;  ///< half of INT |f cos / E - D| dw [0..1]
  double l3 = 0;  ///< INT |f cos / E - D|^3 dw
};
LtcErrors measure_ltc(const LtcCell& cell, double mu, double alpha, const LtcLobe& lobe);

/// The cosine lobe nearest to f cos / E in the mean of |difference|^3, found from the first cell
/// given and from a guess, whichever ends nearer.
///
/// The integral runs over a fixed quadrature in slopes (docs/quadrature.md), mirrored below the
/// horizon where the lobe is 0, and is minimised by Levenberg and Marquardt's method with exact
/// derivatives: no random numbers, and no seed.
///
/// @valid   mu in (0, 1], alpha in [1e-4, 1]
/// @source  Heitz, Dupuy, Hill and Neubelt 2016 (the model, the norm)
LtcCell fit_ltc_cell(double mu, double alpha, const LtcLobe& lobe, const LtcCell& start);

/// A table of fits, row by row: x is the perceptual roughness, y is sqrt(1 - mu), nodes on the
/// borders, mu at least cos(1.57). The same bits for any number of threads.
/// @valid size at least 2x2
std::vector<LtcCell> fit_ltc(Size size, const LtcLobe& lobe = ggx_ltc_lobe());

/// The cosine of a row of that table.
double ltc_cosine(int row, int rows);

/// Irradiance under a uniform disc or sphere that the horizon clips, over that which it would give
/// unclipped and straight above:
///
///     INT_cap max(0, n.w) dw / (pi sin^2 sigma)
///
/// @param cosine  of the angle between the normal and the middle of the cap [-1..1]
/// @param sine2   sin^2 sigma, sigma the angular radius of the cap [0..1]
/// @source        Snyder 1996, "Area Light Sources for Real-Time Graphics"
double sphere_form_factor(double cosine, double sine2);

}  // namespace kiln

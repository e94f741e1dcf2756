// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "kiln/math/vec.h"

namespace kiln {

/// One Gaussian of a diffusion profile: weight * exp(-r^2 / (2 variance)) / (2 pi variance).
struct ProfileGaussian {
  double variance;      ///< [mm^2]
  Vec3<double> weight;  ///< linear Rec.709; the weights of a profile sum to 1
};

/// The six Gaussians of the skin of d'Eon and Luebke 2007 (GPU Gems 3, chapter 14).
inline constexpr std::array<ProfileGaussian, 6> skin_profile{{
    {0.0064, {0.233, 0.455, 0.649}},
    {0.0484, {0.100, 0.336, 0.344}},
    {0.187, {0.118, 0.198, 0.000}},
    {0.567, {0.113, 0.007, 0.007}},
    {1.99, {0.358, 0.004, 0.000}},
    {7.41, {0.078, 0.000, 0.000}},
}};

/// Light that skin on a ball of the curvature c = 1 / radius sends back where the normal stands at
/// an angle theta from a distant light, relative to a flat patch that faces it:
///
///     D = INT max(0, cos(theta + x)) R(2 sin(x / 2) / c) dx / INT R(2 sin(x / 2) / c) dx
///
/// both over [-pi, pi]. A Gaussian of the profile becomes exp(k (cos x - 1)), k = 1 / (v c^2), so
/// each is integrated apart, over the arc that light reaches, cut off at nine of its widths and
/// split where it peaks. There the integrand is analytic, which the clamp denies to a rule over the
/// whole circle.
///
/// @param cosine  of theta [-1..1], clamped
/// @param curvature_per_mm  [1/mm] >= 0; 0 is flat: D = max(0, cosine)
/// @param order   points on each side of a peak; 32 err by less than 1e-12
/// @return        linear Rec.709, in [0, 1]
/// @source        Penner 2011, "Pre-Integrated Skin Shading"
Vec3<double> integrate_skin(double cosine, double curvature_per_mm, int order = 32);

}  // namespace kiln

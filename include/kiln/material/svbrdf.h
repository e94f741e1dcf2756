// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <vector>

#include "kiln/image/plane.h"
#include "kiln/image/wrap.h"

namespace kiln {

/// A spatially varying BRDF: what every workflow comes to, texel by texel, in the working space.
struct Svbrdf {
  std::string name;
  Size size;
  Wrap wrap = Wrap::Repeat;            ///< what lies beyond its edges
  std::array<Plane, 3> diffuse_color;  ///< diffuse reflectance, linear [0..1]
  std::array<Plane, 3> f0;             ///< specular reflectance at normal incidence, linear [0..1]
  Plane roughness;                     ///< perceptual [0..1]
  std::array<Plane, 3> normal;         ///< unit, +X right, +Y up, +Z out of the surface
  Plane ambient_occlusion;             ///< [0..1], 1 unoccluded
  Plane anisotropy;        ///< as anisotropic_widths() takes it; empty: isotropic everywhere
  Plane anisotropy_angle;  ///< [rad] of the wider axis, counter-clockwise from +x; empty: 0
};

/// Half the size: colours and occlusion averaged linearly, normals as slopes, roughness as squared
/// alpha, r' = (mean r^4)^(1/4), anisotropic lobes as the covariance of their slopes. Roughness is
/// not widened by the variance of the normals. Odd sizes round up; every texel is the exact area
/// average.
Svbrdf halve(const Svbrdf& svbrdf);

/// The SVBRDF and all its halvings down to 1x1.
std::vector<Svbrdf> mip_chain(Svbrdf svbrdf);

}  // namespace kiln

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "kiln/math/vec.h"

namespace kiln {

/// The complex index of refraction n - i k of a material at one wavelength.
struct OpticalConstant {
  double wavelength_nm, n, k;
};

/// Linear Rec.709 colour that a smooth surface of these constants reflects of D65 daylight:
/// the exact conductor reflectance, integrated against the CIE 1931 observer from 380 to 780 nm and
/// divided by what a perfect mirror gives. With the cosine 1 it is F0.
///
/// Constants are interpolated linearly between wavelengths and held beyond the ends. A saturated
/// colour may leave [0,1]: the red of gold is 1.02.
///
/// @param samples  one or more, wavelengths ascending
/// @param cosine   between the direction and the microfacet's normal [0..1]
/// @error    Fault::Input for no samples or wavelengths that do not ascend
/// @accuracy the observer is an analytic fit: the white of D65 comes out at x = 0.3126, y = 0.3292
///           (CIE: 0.3127, 0.3290); colours of metals agree with published ones to 0.02
/// @source   Wyman, Sloan and Shirley 2013 (observer); CIE S 014-2 (D65)
Vec3<double> optical_constants_to_rgb(std::span<const OpticalConstant> samples, double cosine = 1);

}  // namespace kiln

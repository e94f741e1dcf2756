// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "kiln/math/wide.h"

namespace kiln {

/// The least width of a microfacet lobe; below it single precision overflows.
inline constexpr double min_alpha = 1e-4;

/// Perceptual roughness (textures) to alpha (formulas): alpha = roughness^2, at least 1e-4.
/// @valid roughness in [0,1]; values outside are clamped
/// @source Burley 2012
template <class F>
F to_alpha(F roughness) {
  const F r = clamp(roughness, F(0), F(1));
  return max(r * r, F(min_alpha));
}

}  // namespace kiln

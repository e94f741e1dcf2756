// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "kiln/math/wide.h"

namespace kiln {

/// What a rough dielectric reflects and lets through after a single bounce, for both sides,
/// tabulated for path tracing. 1 over it makes up for what bounces more than once.
///
/// Nodes lie on the borders; the axes are sqrt(mu) and sqrt(roughness).
/// @accuracy bilinear lookup, index 1.5: 1e-3 for mu >= 0.05 and roughness >= 0.05; 3e-2 at worst
class GlassAlbedos {
 public:
  static constexpr int nodes = 64;  ///< along each axis

  /// @param ior  of the body over that of its surroundings
  explicit GlassAlbedos(double ior);

  /// @param mu  cosine of the direction to its side's normal [0..1], clamped
  WideFloat total(WideFloat mu, WideFloat roughness, MaskOf<WideFloat> inside) const;

 private:
  std::vector<float> entries_;  // [outside, inside][roughness][mu]
};

}  // namespace kiln

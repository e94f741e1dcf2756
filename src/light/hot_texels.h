// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "color_planes.h"

namespace kiln {

/// The most power that a texel may have, by colour: |radiance| times solid angle.
struct PowerLimit {
  std::array<double, 3> most;
  double least_solid_angle = 0;  ///< smaller texels are held to the radiance of one so large [sr]

  /// The same as radiance of a texel of that solid angle.
  float radiance(size_t color, double solid_angle) const {
    return static_cast<float>(most[color] / std::max(solid_angle, least_solid_angle));
  }
};

/// A share of the power of all texels.
PowerLimit share_of_power(const ColorPlanes& latlong, double share);

/// A texel with more power than the limit in one colour at least.
struct HotTexel {
  int x, y;
  std::array<double, 3> power;  ///< 0 in colours within the limit
};

/// Row by row; at most 3 / share of them.
std::vector<HotTexel> hot_texels(const ColorPlanes& latlong, const PowerLimit& limit);

}  // namespace kiln

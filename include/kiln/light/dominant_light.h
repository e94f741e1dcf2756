// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "kiln/image/layers.h"
#include "kiln/math/vec.h"

namespace kiln {

/// The brightest light of an environment, for engines that draw it apart: a sun, a lamp.
struct DominantLight {
  Vec3<double> direction;   ///< toward the light, unit: of its power
  double solid_angle = 0;   ///< [sr]
  Vec3<double> radiance;    ///< mean over it [W/(m^2 sr), in the units of the image]
  Vec3<double> irradiance;  ///< of a plane that faces it [W/m^2, likewise]
};

/// The texels around the brightest one, by luminance, that are at least half as bright and touch.
/// Nothing where there is no light, or none that is smaller than half a steradian.
std::optional<DominantLight> dominant_light(const Layers& latlong);

}  // namespace kiln

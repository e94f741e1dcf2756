// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "kiln/math/vec.h"

namespace kiln {

/// Light from one direction, infinitely far away and infinitely small.
struct DirectionalLight {
  Vec3<double> toward;      ///< unit, to the light, in the picture's space: +Z to the viewer, +Y up
  Vec3<double> irradiance;  ///< on a plane that faces the light [W/m^2]
};

/// Lights as a user writes them: "dir:x,y,z:r,g,b", several with semicolons between.
/// @error Fault::Usage naming what was found and what was expected
std::vector<DirectionalLight> parse_lights(const std::string& text);

}  // namespace kiln

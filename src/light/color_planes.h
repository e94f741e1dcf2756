// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "kiln/image/layers.h"
#include "kiln/math/vec.h"

namespace kiln {

/// The three colours of an image that outlives them; a grey image gives its one plane thrice.
struct ColorPlanes {
  Size size;
  std::array<const Plane*, 3> planes;

  Vec3<double> at(int x, int y) const {
    return {planes[0]->at(x, y), planes[1]->at(x, y), planes[2]->at(x, y)};
  }
};

/// @error Fault::Input when the image is empty or has neither R, G and B nor one grey plane
ColorPlanes color_planes(const Layers& latlong);

}  // namespace kiln

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "kiln/image/layers.h"

namespace kiln {

/// A texture as engines load it: levels from the largest, each one image or the six faces of a cube
/// in the order of CubeFace (px nx py ny pz nz). All faces of a level have one size and the same
/// channels; each level is half as large as the one before, rounded down, at least 1.
struct Texture {
  std::vector<std::vector<Layers>> levels;  ///< [levels][1 or 6]

  bool is_cube() const { return !levels.empty() && levels.front().size() == 6; }
};

}  // namespace kiln

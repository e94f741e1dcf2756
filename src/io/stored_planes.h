// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "kiln/image/plane.h"

namespace kiln::io {

/// Planes in the order of the file's channels, at least one; nullptr stands for a channel of zeros,
/// never the first.
struct StoredPlanes {
  std::vector<const Plane*> planes;
  std::vector<std::string> names;  ///< as many as planes: names of the layers, or their labels
  int alpha_channel = -1;

  Size size() const { return planes.front()->size(); }
};

}  // namespace kiln::io

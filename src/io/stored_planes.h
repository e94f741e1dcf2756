// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "kiln/image/layers.h"

namespace kiln::io {

/// Planes in the order of the file's channels, at least one; nullptr stands for a channel of zeros,
/// never the first.
struct StoredPlanes {
  std::vector<const Plane*> planes;
  std::vector<std::string> names;  ///< as many as planes: names of the layers, or their labels
  int alpha_channel = -1;

  Size size() const { return planes.front()->size(); }
};

/// R G B A (or Y A) in that order where all names are of these, else as the layers stand.
/// @param labels  to stand for the names, in the order of the layers; else empty
StoredPlanes in_file_order(const Layers& image, const std::vector<std::string>& labels = {});

/// The planes of an image as they stand, the last of four being alpha.
StoredPlanes planes_of(const Layers& image);

}  // namespace kiln::io

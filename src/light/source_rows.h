// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

#include "kiln/image/sphere_image.h"

namespace kiln {

/// No lat-long image that is made of a source has more rows.
inline constexpr int most_rows = 8192;

/// Rows of a lat-long image that is as fine as the source at the equator.
inline int source_rows(const SphereImage& source) {
  const int border = source.node_aligned ? 1 : 0;
  const Size size = source.size();
  switch (source.projection) {
    case SphereImage::Projection::LatLong:
      return std::max(size.height, (size.width + 1) / 2);
    case SphereImage::Projection::Cube:
      return 2 * std::max(1, size.width - border);
    case SphereImage::Projection::Octahedral:
      return size.width;
  }
  return size.height;
}

}  // namespace kiln

// SPDX-License-Identifier: Apache-2.0
#include "kiln/light/sphere_layout.h"

namespace kiln {

Size image_size(SphereLayout layout, int size) {
  switch (layout) {
    case SphereLayout::Cube:
      return {size, size};
    case SphereLayout::LatLong:
      return {2 * size, size};
    case SphereLayout::Octahedral:
      return {2 * size, 2 * size};
  }
  return {};
}

int image_count(SphereLayout layout) { return layout == SphereLayout::Cube ? 6 : 1; }

Vec3<double> direction_of(SphereLayout layout, int image, Vec2<double> uv) {
  switch (layout) {
    case SphereLayout::Cube:
      return normalize(cube_to_direction(static_cast<CubeFace>(image), uv));
    case SphereLayout::LatLong:
      return latlong_to_direction(uv);
    case SphereLayout::Octahedral:
      return octahedral_to_direction(uv);
  }
  return {};
}

void texel_directions(SphereLayout layout, int size, int image, int y,
                      std::vector<Vec3<double>>& directions) {
  const Size extent = image_size(layout, size);
  directions.resize(static_cast<size_t>(extent.width));
  for (int x = 0; x < extent.width; ++x) {
    directions[static_cast<size_t>(x)] =
        direction_of(layout, image, {(x + 0.5) / extent.width, (y + 0.5) / extent.height});
  }
}

}  // namespace kiln

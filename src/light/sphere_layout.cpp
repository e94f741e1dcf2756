// SPDX-License-Identifier: Apache-2.0
#include "kiln/light/sphere_layout.h"

namespace kiln {

Size SphereGrid::image_size() const {
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

Vec2<double> SphereGrid::point(double x, double y) const {
  const Size extent = image_size();
  // A single node stands for the whole.
  if (!at_nodes || extent.width < 2 || extent.height < 2) {
    return {(x + 0.5) / extent.width, (y + 0.5) / extent.height};
  }
  return {x / (extent.width - 1), y / (extent.height - 1)};
}

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

void row_directions(const SphereGrid& grid, int image, int y,
                    std::vector<Vec3<double>>& directions) {
  directions.clear();
  for (int x = 0; x < grid.image_size().width; ++x) {
    directions.push_back(direction_of(grid.layout, image, grid.point(x, y)));
  }
}

}  // namespace kiln

// SPDX-License-Identifier: Apache-2.0
#include "kiln/light/sphere_layout.h"

#include "kiln/light/turn.h"
#include "kiln/parallel/rows.h"

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

Vec3<double> SphereGrid::direction(int image, int x, int y) const {
  return Turn(rotate_deg).to_image(direction_of(layout, image, point(x, y)));
}

void row_directions(const SphereGrid& grid, int image, int y,
                    std::vector<Vec3<double>>& directions) {
  directions.clear();
  const Turn turn(grid.rotate_deg);
  for (int x = 0; x < grid.image_size().width; ++x) {
    directions.push_back(turn.to_image(direction_of(grid.layout, image, grid.point(x, y))));
  }
}

namespace {

// The same corner serves four texels.
std::vector<double> face_solid_angles(int n) {
  const auto corners = static_cast<size_t>(n) + 1;
  std::vector<double> corner(corners * corners);
  for_rows(n + 1, [&](int j) {
    for (int i = 0; i <= n; ++i) {
      corner[static_cast<size_t>(j) * corners + static_cast<size_t>(i)] =
          cube_corner_solid_angle(2.0 * i / n - 1, 2.0 * j / n - 1);
    }
  });
  std::vector<double> found(static_cast<size_t>(n) * static_cast<size_t>(n));
  for (size_t i = 0; i < found.size(); ++i) {
    const size_t at = i / static_cast<size_t>(n) * corners + i % static_cast<size_t>(n);
    found[i] = corner[at] - corner[at + 1] - corner[at + corners] + corner[at + corners + 1];
  }
  return found;
}

}  // namespace

std::vector<Layers> blank_images(const SphereGrid& grid) {
  return std::vector<Layers>(static_cast<size_t>(grid.images()),
                             make_layers(grid.image_size(), {"R", "G", "B"}));
}

std::vector<double> solid_angles(const SphereGrid& grid) {
  const Size size = grid.image_size();
  if (grid.layout == SphereLayout::Cube) return face_solid_angles(size.width);
  std::vector<double> found(static_cast<size_t>(area(size)));
  for_rows(size.height, [&](int y) {
    for (int x = 0; x < size.width; ++x) {
      found[static_cast<size_t>(y) * static_cast<size_t>(size.width) + static_cast<size_t>(x)] =
          grid.layout == SphereLayout::LatLong ? latlong_texel_solid_angle(size, y)
                                               : octahedral_texel_solid_angle(size.width, x, y);
    }
  });
  return found;
}

}  // namespace kiln

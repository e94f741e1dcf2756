// SPDX-License-Identifier: Apache-2.0
#include "sphere_texels.h"

#include <algorithm>
#include <cmath>

namespace kiln {
namespace {

using Projection = SphereImage::Projection;

/// A texel of a face.
struct FaceTexel {
  int face, x, y;
};

// The texel across the edge of a face from (x, y), one of the two just outside. Seen from a point a
// little outside, so that the neighbour's scale along the edge does not matter.
FaceTexel across_edge(int size, int face, int x, int y) {
  constexpr double outside = 1e-6;
  const auto coordinate = [size](int i) {
    if (i < 0) return -outside;
    if (i >= size) return 1 + outside;
    return (i + 0.5) / size;
  };
  const CubePoint point = direction_to_cube(
      cube_to_direction(static_cast<CubeFace>(face), {coordinate(x), coordinate(y)}));
  const auto index = [size](double u) {
    return std::clamp(static_cast<int>(u * size), 0, size - 1);
  };
  return {static_cast<int>(point.face), index(point.uv.x), index(point.uv.y)};
}

}  // namespace

SphereTexels::SphereTexels(const SphereImage& sphere)
    : projection_(sphere.projection),
      node_aligned_(sphere.node_aligned),
      up_(sphere.up),
      size_(sphere.size()) {
  for (const Layers& image : sphere.images) images_.push_back(color_planes(image));
}

SphereTexels::Point SphereTexels::on_image(int image, Vec2<double> uv) const {
  if (node_aligned_) return {image, uv.x * (size_.width - 1), uv.y * (size_.height - 1)};
  return {image, uv.x * size_.width - 0.5, uv.y * size_.height - 0.5};
}

SphereTexels::Point SphereTexels::point_of(const Vec3<double>& d) const {
  if (projection_ == Projection::Cube) {
    const CubePoint point = direction_to_cube(d);
    return on_image(static_cast<int>(point.face), point.uv);
  }
  const Vec3<double> seen = to_image(up_, d);
  return on_image(0, projection_ == Projection::LatLong ? direction_to_latlong(seen)
                                                        : direction_to_octahedral(seen));
}

// Beyond a corner lies the mean of the three texels that meet there: seen from either side, a
// bilinear lookup is then the same on the edges.
Vec3<double> SphereTexels::beyond_face(int face, int x, int y) const {
  const int n = size_.width;
  const int inner_x = std::clamp(x, 0, n - 1), inner_y = std::clamp(y, 0, n - 1);
  const auto across = [&](int column, int row) {
    const FaceTexel found = across_edge(n, face, column, row);
    return images_[static_cast<size_t>(found.face)].at(found.x, found.y);
  };
  if (x == inner_x || y == inner_y) return across(x, y);
  return (texel(face, inner_x, inner_y) + across(x, inner_y) + across(inner_x, y)) * (1.0 / 3);
}

// Half a turn across the poles and around; on an octahedral image each half of an edge lies on the
// other half.
Vec3<double> SphereTexels::beyond(int image, int x, int y) const {
  if (projection_ == Projection::Cube) return beyond_face(image, x, y);
  const auto [width, height] = size_;
  if (projection_ == Projection::LatLong) {
    const bool across = y < 0 || y >= height;
    const int column = x + (across ? width / 2 : 0) + width;
    return texel(image, column % width, std::clamp(y, 0, height - 1));
  }
  if (x < 0 || x >= width) {
    x = std::clamp(x, 0, width - 1);
    y = height - 1 - y;
  }
  if (y < 0 || y >= height) {
    x = width - 1 - x;
    y = std::clamp(y, 0, height - 1);
  }
  return texel(image, x, y);
}

Vec3<double> SphereTexels::texel(int image, int x, int y) const {
  return images_[static_cast<size_t>(image)].at(x, y);
}

Vec3<double> SphereTexels::at(const Vec3<double>& d) const {
  const Point point = point_of(d);
  const double left = std::floor(point.x), top = std::floor(point.y);
  const double tx = point.x - left, ty = point.y - top;
  const int x = static_cast<int>(left), y = static_cast<int>(top);
  const auto corner = [&](int column, int row, double weight) {
    if (weight == 0) return Vec3<double>{};
    return weight * (inside(column, row) ? texel(point.image, column, row)
                                         : beyond(point.image, column, row));
  };
  return corner(x, y, (1 - tx) * (1 - ty)) + corner(x + 1, y, tx * (1 - ty)) +
         corner(x, y + 1, (1 - tx) * ty) + corner(x + 1, y + 1, tx * ty);
}

}  // namespace kiln

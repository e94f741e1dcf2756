// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "color_planes.h"
#include "kiln/image/sphere_image.h"

namespace kiln {

/// An environment of any projection, looked up bilinearly without seams. Keeps no copy: the image
/// must outlive it.
class SphereTexels {
 public:
  /// @param sphere  not a lat-long image with samples on its borders
  /// @error Fault::Input when it has neither one nor three colours
  explicit SphereTexels(const SphereImage& sphere);

  /// Radiance at the unit direction d of the world.
  Vec3<double> at(const Vec3<double>& d) const;

 private:
  /// A point among the samples, which lie at whole numbers.
  struct Point {
    int image;
    double x, y;
  };
  Point point_of(const Vec3<double>& d) const;
  Point on_image(int image, Vec2<double> uv) const;

  Vec3<double> texel(int image, int x, int y) const;
  Vec3<double> beyond(int image, int x, int y) const;
  Vec3<double> beyond_face(int face, int x, int y) const;
  bool inside(int x, int y) const {
    return x >= 0 && y >= 0 && x < size_.width && y < size_.height;
  }

  SphereImage::Projection projection_;
  bool node_aligned_;
  Up up_;
  Size size_;
  std::vector<ColorPlanes> images_;
};

}  // namespace kiln

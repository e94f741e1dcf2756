// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "kiln/image/layers.h"
#include "kiln/image/projection.h"

namespace kiln {

/// Which axis of the directions of an image points up.
enum class Up { Y, Z };
inline constexpr std::array<std::string_view, 2> up_names = {"y", "z"};

/// Whether the directions of an image are of the other handedness, +X and -X exchanged.
enum class Mirror { None, X };
inline constexpr std::array<std::string_view, 2> mirror_names = {"none", "x"};

/// A function of direction as images: all that is seen from one point.
struct SphereImage {
  enum class Projection { LatLong, Cube, Octahedral };

  Projection projection = Projection::LatLong;
  std::vector<Layers> images;  ///< one, or the six faces of a cube in the order of CubeFace
  /// Samples lie on the borders: outer rows and columns on the edges of a face; of a lat-long image
  /// the first column is the last, and the rows at the poles are constant.
  bool node_aligned = false;
  Up up = Up::Y;  ///< of directions as kiln/image/projection.h maps them; Y for cubes

  Size size() const { return images.empty() ? Size{} : images.front().size; }
};

SphereImage latlong_image(Layers image, bool node_aligned = false);

/// @param faces  in the order and orientation of CubeFace
/// @error Fault::Input when these are not six squares of one size with the same channels
SphereImage cube_image(std::vector<Layers> faces, bool node_aligned = false);

/// @error Fault::Input when the image is not square
SphereImage octahedral_image(Layers image);

/// Exchanges +X and -X, in place.
void mirror_x(SphereImage& sphere);

/// States which axis of the image points up: +Z up becomes +Y up, +Y then -Z, and +X stays. Faces
/// of cubes are turned at once, without a change to any value; of other images it is noted.
void set_up(SphereImage& sphere, Up up);

/// The direction of the image that is seen at the direction d of the world, and back.
inline Vec3<double> to_image(Up up, const Vec3<double>& d) {
  return up == Up::Y ? d : Vec3<double>{d.x, -d.z, d.y};
}
inline Vec3<double> from_image(Up up, const Vec3<double>& d) {
  return up == Up::Y ? d : Vec3<double>{d.x, d.z, -d.y};
}

/// Unit direction of the world at sample (x, y) of an image, or of a face.
Vec3<double> sample_direction(const SphereImage& sphere, int image, int x, int y);

/// Exact solid angle that the sample stands for: of its texel, or of what is nearest to the node.
/// All sum to 4 pi [sr].
double sample_solid_angle(const SphereImage& sphere, int x, int y);

/// A cube with its faces put in another order and orientation.
/// @param from  where to find what belongs at a point of a face; it maps texels to texels
SphereImage rearranged(SphereImage cube, CubePoint (*from)(const CubePoint&));

}  // namespace kiln

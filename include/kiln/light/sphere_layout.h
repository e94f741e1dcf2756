// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "kiln/image/projection.h"

namespace kiln {

/// How the sphere lies in images. The size of each is stated by the edge N of a cube face.
enum class SphereLayout {
  Cube,        ///< six faces of N x N
  LatLong,     ///< 2N x N
  Octahedral,  ///< 2N x 2N
};
inline constexpr std::array<std::string_view, 3> sphere_layout_names = {"cube", "latlong",
                                                                        "octahedral"};

/// Size of an image, or of one face.
Size image_size(SphereLayout layout, int size);

/// 6 of a cube, else 1.
int image_count(SphereLayout layout);

/// Unit direction through the point (u, v) in [0,1]^2 of an image, v down.
Vec3<double> direction_of(SphereLayout layout, int image, Vec2<double> uv);

/// Unit directions of the texel centres in row y of an image, or of a face.
void texel_directions(SphereLayout layout, int size, int image, int y,
                      std::vector<Vec3<double>>& directions);

}  // namespace kiln

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "kiln/image/layers.h"
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

/// Where the sphere is sampled.
struct SphereGrid {
  SphereLayout layout = SphereLayout::Cube;
  int size = 256;         ///< N
  bool at_nodes = false;  ///< the outermost samples lie on the borders, else all at texel centres
  double rotate_deg = 0;  ///< of the environment, positive turns +Z toward +X [degree]

  /// 6 of a cube, else 1.
  int images() const { return layout == SphereLayout::Cube ? 6 : 1; }
  Size image_size() const;
  /// Where sample (x, y) of an image lies, in [0,1]^2; fractions between samples too.
  Vec2<double> point(double x, double y) const;
  /// The direction of the source that sample (x, y) of an image shows, unit.
  Vec3<double> direction(int image, int x, int y) const;
};

/// Unit direction through the point (u, v) in [0,1]^2 of an image, v down.
Vec3<double> direction_of(SphereLayout layout, int image, Vec2<double> uv);

/// The directions of all samples in row y of an image, or of a face.
void row_directions(const SphereGrid& grid, int image, int y,
                    std::vector<Vec3<double>>& directions);

/// The images of a grid, planes R G B, dark.
std::vector<Layers> blank_images(const SphereGrid& grid);

/// Exact solid angles of the texels of an image, or of any face, row by row [sr]; of a grid at
/// nodes as if it had texel centres.
std::vector<double> solid_angles(const SphereGrid& grid);

}  // namespace kiln

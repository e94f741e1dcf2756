// SPDX-License-Identifier: Apache-2.0
#include "kiln/image/sphere_image.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "kiln/core/error.h"
#include "kiln/parallel/rows.h"

namespace kiln {
namespace {

using Projection = SphereImage::Projection;

void require_square(const Layers& image, std::string_view what) {
  if (image.size.width == image.size.height && image.size.width > 0) return;
  throw Error(Fault::Input, fmt::format("{} is {} x {}, expected a square", what, image.size.width,
                                        image.size.height));
}

bool same_channels(const Layers& a, const Layers& b) {
  return std::equal(a.layers.begin(), a.layers.end(), b.layers.begin(), b.layers.end(),
                    [](const Layer& x, const Layer& y) { return x.name == y.name; });
}

/// Where texel (x, y) of a face is found: on one face, at an origin plus x and y steps.
struct FaceTurn {
  size_t face;
  int x, y;
  int right_x, right_y, down_x, down_y;
};

FaceTurn turn_of(int n, int face, CubePoint (*from)(const CubePoint&)) {
  const auto found = [&](int x, int y) {
    return from({static_cast<CubeFace>(face), {(x + 0.5) / n, (y + 0.5) / n}});
  };
  const auto index = [n](double u) { return static_cast<int>(std::lround(u * n - 0.5)); };
  const int last = n - 1, steps = std::max(last, 1);
  const CubePoint origin = found(0, 0), right = found(last, 0), down = found(0, last);
  const int x = index(origin.uv.x), y = index(origin.uv.y);
  return {static_cast<size_t>(origin.face),
          x,
          y,
          (index(right.uv.x) - x) / steps,
          (index(right.uv.y) - y) / steps,
          (index(down.uv.x) - x) / steps,
          (index(down.uv.y) - y) / steps};
}

Plane turned(const Plane& from, const FaceTurn& turn) {
  Plane to(from.size());
  for_rows(to.height(), [&](int y) {
    int column = turn.x + y * turn.down_x, row = turn.y + y * turn.down_y;
    for (int x = 0; x < to.width(); ++x, column += turn.right_x, row += turn.right_y) {
      to.at(x, y) = from.at(column, row);
    }
  });
  return to;
}

CubePoint mirrored(const CubePoint& at) {
  const Vec3<double> d = cube_to_direction(at.face, at.uv);
  return direction_to_cube({-d.x, d.y, d.z});
}

CubePoint of_z_up(const CubePoint& at) {
  return direction_to_cube(to_image(Up::Z, cube_to_direction(at.face, at.uv)));
}

}  // namespace

SphereImage latlong_image(Layers image, bool node_aligned) {
  SphereImage sphere;
  sphere.images.push_back(std::move(image));
  sphere.node_aligned = node_aligned;
  return sphere;
}

SphereImage cube_image(std::vector<Layers> faces, bool node_aligned) {
  if (faces.size() != 6) {
    throw Error(Fault::Input, fmt::format("a cube of {} faces, expected six", faces.size()));
  }
  for (size_t f = 0; f < 6; ++f) {
    const std::string name = fmt::format("face {}", cube_face_names[f]);
    require_square(faces[f], name);
    if (faces[f].size != faces[0].size) {
      throw Error(Fault::Input, fmt::format("{} is {} x {}, expected {} x {} as face px", name,
                                            faces[f].size.width, faces[f].size.height,
                                            faces[0].size.width, faces[0].size.height));
    }
    if (!same_channels(faces[f], faces[0])) {
      throw Error(Fault::Input, name + " has other channels than face px");
    }
  }
  if (node_aligned && faces[0].size.width < 2) {
    throw Error(Fault::Input, "a cube with samples on its borders needs faces of at least 2 x 2");
  }
  return {Projection::Cube, std::move(faces), node_aligned};
}

SphereImage octahedral_image(Layers image) {
  require_square(image, "the octahedral image");
  SphereImage sphere;
  sphere.projection = Projection::Octahedral;
  sphere.images.push_back(std::move(image));
  return sphere;
}

SphereImage rearranged(SphereImage cube, CubePoint (*from)(const CubePoint&)) {
  std::vector<FaceTurn> turns;
  turns.reserve(6);
  for (int face = 0; face < 6; ++face) turns.push_back(turn_of(cube.size().width, face, from));
  for (size_t layer = 0; layer < cube.images[0].layers.size(); ++layer) {
    std::vector<Plane> planes;
    planes.reserve(turns.size());
    for (const FaceTurn& turn : turns) {
      planes.push_back(turned(cube.images[turn.face].layers[layer].plane, turn));
    }
    for (size_t face = 0; face < 6; ++face) {
      cube.images[face].layers[layer].plane = std::move(planes[face]);
    }
  }
  return cube;
}

void mirror_x(SphereImage& sphere) {
  if (sphere.projection == Projection::Cube) {
    sphere = rearranged(std::move(sphere), mirrored);
    return;
  }
  for (Layer& layer : sphere.images[0].layers) {
    for_rows(layer.plane.height(), [&](int y) {
      float* row = layer.plane.row(y);
      std::reverse(row, row + layer.plane.width());
    });
  }
}

void set_up(SphereImage& sphere, Up up) {
  if (up == sphere.up) return;
  if (sphere.projection == Projection::Cube) {
    sphere = rearranged(std::move(sphere), of_z_up);
  } else {
    sphere.up = up;
  }
}

Vec3<double> sample_direction(const SphereImage& sphere, int image, int x, int y) {
  const Size size = sphere.size();
  const auto uv = [&]() -> Vec2<double> {
    if (!sphere.node_aligned) return {(x + 0.5) / size.width, (y + 0.5) / size.height};
    return {static_cast<double>(x) / (size.width - 1), static_cast<double>(y) / (size.height - 1)};
  }();
  switch (sphere.projection) {
    case Projection::LatLong:
      return from_image(sphere.up, latlong_to_direction(uv));
    case Projection::Cube:
      return normalize(cube_to_direction(static_cast<CubeFace>(image), uv));
    case Projection::Octahedral:
      return from_image(sphere.up, octahedral_to_direction(uv));
  }
  return {};
}

double sample_solid_angle(const SphereImage& sphere, int x, int y) {
  const int n = sphere.size().width;
  switch (sphere.projection) {
    case Projection::LatLong:
      return latlong_texel_solid_angle(sphere.size(), y);
    case Projection::Cube:
      return sphere.node_aligned ? cube_node_solid_angle(n, x, y) : cube_texel_solid_angle(n, x, y);
    case Projection::Octahedral:
      return octahedral_texel_solid_angle(n, x, y);
  }
  return 0;
}

}  // namespace kiln

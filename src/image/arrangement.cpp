// SPDX-License-Identifier: Apache-2.0
#include "kiln/image/arrangement.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "kiln/core/error.h"
#include "kiln/parallel/rows.h"

namespace kiln {
namespace {

/// Where a face lies in an image of `columns` x `rows` faces.
struct FacePlace {
  int column, row;
  bool half_turn = false;
};

struct Net {
  Arrangement arrangement;
  int columns, rows;
  std::array<FacePlace, 6> places;  ///< in the order of CubeFace
};

constexpr std::array<Net, 4> nets = {
    {{Arrangement::CubeStrip, 6, 1, {{{0, 0}, {1, 0}, {2, 0}, {3, 0}, {4, 0}, {5, 0}}}},
     {Arrangement::CubeStrip, 1, 6, {{{0, 0}, {0, 1}, {0, 2}, {0, 3}, {0, 4}, {0, 5}}}},
     {Arrangement::CubeCross, 4, 3, {{{2, 1}, {0, 1}, {1, 0}, {1, 2}, {1, 1}, {3, 1}}}},
     {Arrangement::CubeCross, 3, 4, {{{2, 1}, {0, 1}, {1, 0}, {1, 2}, {1, 1}, {1, 3, true}}}}}};

bool fits(const Net& net, Size size) {
  return size.width % net.columns == 0 && size.height % net.rows == 0 &&
         size.width / net.columns == size.height / net.rows;
}

const Net* net_of(Arrangement arrangement, Size size) {
  const auto found = std::find_if(nets.begin(), nets.end(), [&](const Net& net) {
    return (arrangement == Arrangement::Auto || net.arrangement == arrangement) && fits(net, size);
  });
  return found == nets.end() ? nullptr : &*found;
}

// With samples on the borders, one more of them than cells each way is as good.
bool is_latlong(const ImageMarks& marks) {
  const auto [width, height] = marks.size;
  return width == 2 * height || (marks.node_aligned && width - 1 == 2 * (height - 1));
}

std::string ratio_text(const Net& net) { return fmt::format("{}:{}", net.columns, net.rows); }

std::string found_text(Size size) { return fmt::format("found {} x {}", size.width, size.height); }

std::string_view expected_of(Arrangement arrangement) {
  switch (arrangement) {
    case Arrangement::LatLong:
      return "twice as wide as high";
    case Arrangement::CubeStrip:
      return "six square faces in a row, 6N x N or N x 6N";
    case Arrangement::CubeCross:
      return "square faces in a cross, 4N x 3N or 3N x 4N";
    case Arrangement::Octahedral:
      return "a square";
    default:
      return "";
  }
}

[[noreturn]] void refuse(Arrangement arrangement, Size size) {
  throw Error(Fault::Input, fmt::format("{}, expected {} (projection {})", found_text(size),
                                        expected_of(arrangement),
                                        arrangement_names[static_cast<size_t>(arrangement)]));
}

// Throws where the size does not fit; returns the ratio.
std::string checked_ratio(Arrangement arrangement, const ImageMarks& marks) {
  const auto [width, height] = marks.size;
  if (arrangement == Arrangement::LatLong) {
    if (!is_latlong(marks)) refuse(arrangement, marks.size);
    return "2:1";
  }
  if (arrangement == Arrangement::Octahedral) {
    if (width != height) refuse(arrangement, marks.size);
    return "1:1";
  }
  const Net* net = net_of(arrangement, marks.size);
  if (net == nullptr) refuse(arrangement, marks.size);
  return ratio_text(*net);
}

ArrangementChoice by_ratio(const ImageMarks& marks) {
  if (is_latlong(marks)) return {Arrangement::LatLong, "2:1"};
  if (const Net* net = net_of(Arrangement::Auto, marks.size)) {
    return {net->arrangement, ratio_text(*net)};
  }
  if (marks.size.width == marks.size.height) {
    throw Error(Fault::Input, found_text(marks.size) +
                                  ", a square. Octahedral? State the projection: octahedral");
  }
  throw Error(Fault::Input,
              found_text(marks.size) +
                  ", expected 2:1 (latlong), 6:1 or 1:6 (cube-strip), 4:3 or 3:4 (cube-cross)");
}

Plane cut(const Plane& from, int n, const FacePlace& place) {
  Plane face({n, n});
  for_rows(n, [&](int y) {
    const int row = place.half_turn ? n - 1 - y : y;
    const float* begin = from.row(place.row * n + row) + place.column * n;
    if (place.half_turn) {
      std::reverse_copy(begin, begin + n, face.row(y));
    } else {
      std::copy_n(begin, n, face.row(y));
    }
  });
  return face;
}

std::vector<Layers> cut_faces(Layers image, const Net& net) {
  const int n = image.size.width / net.columns;
  std::vector<Layers> faces(6, Layers{{n, n}, {}});
  for (Layer& layer : image.layers) {
    for (size_t f = 0; f < faces.size(); ++f) {
      faces[f].layers.push_back({layer.name, cut(layer.plane, n, net.places[f])});
    }
    layer.plane = Plane();
  }
  return faces;
}

CubePoint of_openexr(const CubePoint& at) {
  const bool side = at.face != CubeFace::py && at.face != CubeFace::ny;
  return {at.face, side ? Vec2<double>{1 - at.uv.x, at.uv.y} : Vec2<double>{at.uv.x, 1 - at.uv.y}};
}

}  // namespace

ArrangementChoice choose_arrangement(Arrangement stated, const ImageMarks& marks) {
  if (stated == Arrangement::CubeFaces) {
    throw Error(Fault::Input,
                "one file, expected six (projection cube-faces): a path with <FACE> in it, or a "
                "folder");
  }
  if (stated != Arrangement::Auto) {
    return {stated, checked_ratio(stated, marks) + ", as stated"};
  }
  if (marks.envmap == Envmap::None) return by_ratio(marks);
  const Arrangement marked =
      marks.envmap == Envmap::LatLong ? Arrangement::LatLong : Arrangement::CubeStrip;
  return {marked, checked_ratio(marked, marks) + ", the file's attribute envmap"};
}

SphereImage arranged(Layers image, Arrangement arrangement, const ImageMarks& marks) {
  checked_ratio(arrangement, marks);
  if (arrangement == Arrangement::LatLong) {
    return latlong_image(std::move(image), marks.node_aligned);
  }
  if (arrangement == Arrangement::Octahedral) {
    if (!marks.node_aligned) return octahedral_image(std::move(image));
    throw Error(Fault::Input, "octahedral images with samples on their borders are not read");
  }
  const Net& net = *net_of(arrangement, marks.size);
  SphereImage cube = cube_image(cut_faces(std::move(image), net), marks.node_aligned);
  return marks.envmap == Envmap::Cube ? rearranged(std::move(cube), of_openexr) : cube;
}

}  // namespace kiln

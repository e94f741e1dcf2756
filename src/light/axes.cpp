// SPDX-License-Identifier: Apache-2.0
#include "kiln/light/axes.h"

#include <algorithm>

#include "kiln/core/error.h"
#include "kiln/image/projection.h"
#include "kiln/parallel/rows.h"

namespace kiln {
namespace {

[[noreturn]] void refuse(const std::string& text) {
  throw Error(Fault::Usage,
              "axes: found '" + text + "', expected x, y and z, each once, such as -x,y,z");
}

double coordinate(const Vec3<double>& d, int axis) {
  return axis == 0 ? d.x : axis == 1 ? d.y : d.z;
}

}  // namespace

Vec3<double> Axes::to_engine(const Vec3<double>& d) const {
  return {sign[0] * coordinate(d, axis[0]), sign[1] * coordinate(d, axis[1]),
          sign[2] * coordinate(d, axis[2])};
}

Vec3<double> Axes::to_kiln(const Vec3<double>& d) const {
  std::array<double, 3> result{};
  for (size_t i = 0; i < 3; ++i) {
    result[static_cast<size_t>(axis[i])] = sign[i] * coordinate(d, static_cast<int>(i));
  }
  return {result[0], result[1], result[2]};
}

Axes parse_axes(const std::string& text) {
  Axes axes;
  size_t at = 0;
  std::array<bool, 3> seen{};
  for (size_t i = 0; i < 3; ++i) {
    axes.sign[i] = at < text.size() && text[at] == '-' ? -1 : 1;
    if (at < text.size() && (text[at] == '-' || text[at] == '+')) ++at;
    if (at >= text.size() || text[at] < 'x' || text[at] > 'z') refuse(text);
    axes.axis[i] = text[at++] - 'x';
    seen[static_cast<size_t>(axes.axis[i])] = true;
    if (i < 2 && (at >= text.size() || text[at++] != ',')) refuse(text);
  }
  if (at != text.size() || std::count(seen.begin(), seen.end(), true) != 3) refuse(text);
  return axes;
}

std::vector<Layers> faces_in(const Axes& axes, const std::vector<Layers>& faces) {
  if (axes.is_identity()) return faces;
  const int size = faces.front().size.width;
  std::vector<Layers> turned = faces;
  for_rows(6 * size, [&](int row) {
    const int face = row / size, y = row % size;
    for (int x = 0; x < size; ++x) {
      const Vec2<double> uv{(x + 0.5) / size, (y + 0.5) / size};
      const CubePoint from =
          direction_to_cube(axes.to_kiln(cube_to_direction(static_cast<CubeFace>(face), uv)));
      const auto texel = [size](double u) {
        return std::clamp(static_cast<int>(u * size), 0, size - 1);
      };
      const Layers& source = faces[static_cast<size_t>(from.face)];
      Layers& to = turned[static_cast<size_t>(face)];
      for (size_t c = 0; c < to.layers.size(); ++c) {
        to.layers[c].plane.at(x, y) = source.layers[c].plane.at(texel(from.uv.x), texel(from.uv.y));
      }
    }
  });
  return turned;
}

}  // namespace kiln

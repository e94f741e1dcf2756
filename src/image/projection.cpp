// SPDX-License-Identifier: Apache-2.0
#include "kiln/image/projection.h"

#include <algorithm>
#include <array>

namespace kiln {

double latlong_texel_solid_angle(Size size, int y) {
  // cos(a) - cos(b) = 2 sin((a+b)/2) sin((b-a)/2) keeps its digits at the poles.
  const double step = pi / size.height;
  const double band = 2 * std::sin((y + 0.5) * step) * std::sin(0.5 * step);
  return 2 * pi / size.width * band;
}

Vec3<double> cube_to_direction(CubeFace face, Vec2<double> uv) {
  const double s = 2 * uv.x - 1, t = 2 * uv.y - 1;
  switch (face) {
    case CubeFace::px:
      return {1, -t, -s};
    case CubeFace::nx:
      return {-1, -t, s};
    case CubeFace::py:
      return {s, 1, t};
    case CubeFace::ny:
      return {s, -1, -t};
    case CubeFace::pz:
      return {s, -t, 1};
    default:
      return {-s, -t, -1};
  }
}

CubePoint direction_to_cube(const Vec3<double>& d) {
  const double ax = std::abs(d.x), ay = std::abs(d.y), az = std::abs(d.z);
  const auto point = [](CubeFace face, double s, double t, double major) {
    return CubePoint{face, {0.5 * (s / major + 1), 0.5 * (t / major + 1)}};
  };
  if (ax >= ay && ax >= az) {
    return d.x > 0 ? point(CubeFace::px, -d.z, -d.y, ax) : point(CubeFace::nx, d.z, -d.y, ax);
  }
  if (ay >= az) {
    return d.y > 0 ? point(CubeFace::py, d.x, d.z, ay) : point(CubeFace::ny, d.x, -d.z, ay);
  }
  return d.z > 0 ? point(CubeFace::pz, d.x, -d.y, az) : point(CubeFace::nz, -d.x, -d.y, az);
}

Vec3<double> octahedral_to_direction(Vec2<double> uv) { return normalize(octahedral_point(uv)); }

Vec2<double> direction_to_octahedral(const Vec3<double>& d) {
  const double sum = std::abs(d.x) + std::abs(d.y) + std::abs(d.z);
  const double x = d.x / sum, z = d.z / sum;
  const double s = d.y >= 0 ? x : std::copysign(1 - std::abs(z), x);
  const double t = d.y >= 0 ? z : std::copysign(1 - std::abs(x), z);
  return {0.5 * (s + 1), 0.5 * (t + 1)};
}

namespace {

// Van Oosterom and Strackee 1983.
double triangle_solid_angle(const Vec3<double>& a, const Vec3<double>& b, const Vec3<double>& c) {
  return 2 * std::atan2(std::abs(dot(a, cross(b, c))), 1 + dot(a, b) + dot(b, c) + dot(c, a));
}

/// A rectangle, cut once.
struct Polygon {
  std::array<Vec2<double>, 5> corners;
  size_t count = 0;

  void add(Vec2<double> corner) { corners[count++] = corner; }
};

/// The part of a convex polygon in the plane where side * (x + y - 1) <= 0.
Polygon cut_at_fold(const std::array<Vec2<double>, 4>& rectangle, double side) {
  Polygon kept;
  for (size_t i = 0; i < rectangle.size(); ++i) {
    const Vec2<double> a = rectangle[i], b = rectangle[(i + 1) % rectangle.size()];
    const double beyond_a = side * (a.x + a.y - 1), beyond_b = side * (b.x + b.y - 1);
    if (beyond_a <= 0) kept.add(a);
    if (beyond_a * beyond_b >= 0) continue;
    const double t = beyond_a / (beyond_a - beyond_b);
    kept.add({a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)});
  }
  return kept;
}

// Solid angle of the rectangle between two points of [0,1]^2, one quarter of an octahedral map with
// +Y at the origin. On either side of the fold it lies on one face of the octahedron, where
// straight lines are great circles.
double quarter_solid_angle(Vec2<double> from, Vec2<double> to) {
  const std::array<Vec2<double>, 4> rectangle = {from, {to.x, from.y}, to, {from.x, to.y}};
  const auto direction = [](Vec2<double> at) {
    return octahedral_to_direction({0.5 * (at.x + 1), 0.5 * (at.y + 1)});
  };
  double sum = 0;
  for (const double side : {1.0, -1.0}) {
    const Polygon part = cut_at_fold(rectangle, side);
    if (part.count < 3) continue;
    const Vec3<double> first = direction(part.corners[0]);
    for (size_t i = 2; i < part.count; ++i) {
      sum +=
          triangle_solid_angle(first, direction(part.corners[i - 1]), direction(part.corners[i]));
    }
  }
  return sum;
}

// Distance from the middle of a map of the edges of texel i, between them 0 where the middle is.
std::array<double, 3> distances_from_middle(int n, int i) {
  const double from = 2.0 * i / n - 1, to = 2.0 * (i + 1) / n - 1;
  const double nearest = from < 0 && to > 0 ? 0 : std::min(std::abs(from), std::abs(to));
  return {std::abs(from), nearest, std::abs(to)};
}

}  // namespace

// A texel of an odd map may lie on both sides of the middle, where the octahedron has an edge: then
// it has two parts each way, else one of them is empty.
double octahedral_texel_solid_angle(int n, int x, int y) {
  const auto s = distances_from_middle(n, x), t = distances_from_middle(n, y);
  double sum = 0;
  for (const double farthest_s : {s[0], s[2]}) {
    for (const double farthest_t : {t[0], t[2]}) {
      if (farthest_s <= s[1] || farthest_t <= t[1]) continue;
      sum += quarter_solid_angle({s[1], t[1]}, {farthest_s, farthest_t});
    }
  }
  return sum;
}

double cube_corner_solid_angle(double s, double t) {
  return std::atan2(s * t, std::sqrt(s * s + t * t + 1));
}

double cube_rectangle_solid_angle(Vec2<double> from, Vec2<double> to) {
  const auto corner = cube_corner_solid_angle;
  return corner(from.x, from.y) - corner(to.x, from.y) - corner(from.x, to.y) + corner(to.x, to.y);
}

double cube_texel_solid_angle(int n, int x, int y) {
  const auto edge = [n](int i) { return 2.0 * i / n - 1; };
  return cube_rectangle_solid_angle({edge(x), edge(y)}, {edge(x + 1), edge(y + 1)});
}

double cube_node_solid_angle(int n, int x, int y) {
  const auto edge = [n](double i) { return std::clamp(2 * i / (n - 1) - 1, -1.0, 1.0); };
  return cube_rectangle_solid_angle({edge(x - 0.5), edge(y - 0.5)}, {edge(x + 0.5), edge(y + 0.5)});
}

}  // namespace kiln

// SPDX-License-Identifier: Apache-2.0
#include "kiln/image/projection.h"

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

}  // namespace

double octahedral_texel_solid_angle(int n, int x, int y) {
  const auto corner = [n](int i, int j) {
    return octahedral_to_direction(
        Vec2<double>{static_cast<double>(i) / n, static_cast<double>(j) / n});
  };
  return triangle_solid_angle(corner(x, y), corner(x + 1, y), corner(x, y + 1)) +
         triangle_solid_angle(corner(x + 1, y), corner(x + 1, y + 1), corner(x, y + 1));
}

double cube_texel_solid_angle(int n, int x, int y) {
  const auto corner = [n](int i, int j) {
    const double s = 2.0 * i / n - 1, t = 2.0 * j / n - 1;
    return std::atan2(s * t, std::sqrt(s * s + t * t + 1));
  };
  return corner(x, y) - corner(x + 1, y) - corner(x, y + 1) + corner(x + 1, y + 1);
}

}  // namespace kiln

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>

#include "kiln/core/size.h"
#include "kiln/math/vec.h"

namespace kiln {

// Lat-long: +Y up, image centre +Z, left quarter +X, right quarter -X. u, v in [0,1], v down.
//
//     d = (-sin(phi) sin(theta), cos(theta), cos(phi) sin(theta)),   phi = 2 pi (u - 1/2),
//                                                                    theta = pi v

/// Direction of the lat-long point (u, v).
template <class F>
Vec3<F> latlong_to_direction(Vec2<F> uv) {
  const F phi = (uv.x - F(0.5)) * F(2 * pi);
  const F theta = uv.y * F(pi);
  const F s = sin(theta);
  return {-sin(phi) * s, cos(theta), cos(phi) * s};
}

/// Lat-long point (u, v) in [0,1]^2 of the unit direction d.
template <class F>
Vec2<F> direction_to_latlong(const Vec3<F>& d) {
  const F phi = atan2(-d.x, d.z);
  const F theta = atan2(sqrt(fma(d.x, d.x, d.z * d.z)), d.y);
  return {fma(phi, F(0.5 / pi), F(0.5)), theta * F(1 / pi)};
}

/// Exact solid angle of one texel in row y of a lat-long image [sr].
double latlong_texel_solid_angle(Size size, int y);

/// Cube faces in the order of the OpenGL / KTX / DDS containers.
enum class CubeFace { px, nx, py, ny, pz, nz };
inline constexpr std::array<std::string_view, 6> cube_face_names = {"px", "nx", "py",
                                                                    "ny", "pz", "nz"};

/// Direction through the point (u, v) in [0,1]^2 of a face, v down, not normalised.
///
/// The faces are those of the OpenGL specification (a cube seen from inside, +Y up):
/// px (1, -t, -s), nx (-1, -t, s), py (s, 1, t), ny (s, -1, -t), pz (s, -t, 1), nz (-s, -t, -1)
/// with s = 2u - 1, t = 2v - 1.
Vec3<double> cube_to_direction(CubeFace face, Vec2<double> uv);

struct CubePoint {
  CubeFace face;
  Vec2<double> uv;  ///< [0,1]^2, v down
};
CubePoint direction_to_cube(const Vec3<double>& d);

/// The point of the octahedron |x| + |y| + |z| = 1 at (u, v) in [0,1]^2 of an octahedral map, not
/// normalised: +Y in the middle, -Y in the corners; u toward +X, v toward +Z.
template <class F>
Vec3<F> octahedral_point(const Vec2<F>& uv) {
  const F s = fma(F(2), uv.x, F(-1)), t = fma(F(2), uv.y, F(-1));
  const F height = F(1) - abs(s) - abs(t);
  const F fold = max(-height, F(0));
  return {s - copysign(fold, s), height, t - copysign(fold, t)};
}

/// Unit direction of the point (u, v) in [0,1]^2 of an octahedral map, and back.
Vec3<double> octahedral_to_direction(Vec2<double> uv);
Vec2<double> direction_to_octahedral(const Vec3<double>& d);

/// Exact solid angle of texel (x, y) of an octahedral map with edge n [sr].
double octahedral_texel_solid_angle(int n, int x, int y);

/// Exact solid angle of texel (x, y) of a cube face with edge n [sr].
double cube_texel_solid_angle(int n, int x, int y);

}  // namespace kiln

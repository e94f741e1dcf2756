// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "kiln/image/plane.h"
#include "kiln/material/svbrdf.h"
#include "kiln/math/vec.h"

namespace kiln {

/// What a texel's maps say; lanes hold texels.
template <class F>
struct TexelValues {
  Vec3<F> diffuse_color, f0;
  F roughness;
  Vec3<F> normal;  ///< tangent space, unit
  F occlusion;
  Vec2<F> anisotropy;  ///< a (cos 2 angle, sin 2 angle), a and angle as in Svbrdf; may be mixed
};

inline constexpr int svbrdf_planes = 13;

/// Planes [first, last) of them.
struct PlaneRange {
  int first = 0, last = svbrdf_planes;
};
inline constexpr PlaneRange relief_planes{6, 10};  ///< roughness and normal

/// The planes of an SVBRDF in one order, for loops over all of them. Empty ones hold 0.
inline std::array<const Plane*, svbrdf_planes> planes_of(const Svbrdf& s) {
  return {&s.diffuse_color[0],
          &s.diffuse_color[1],
          &s.diffuse_color[2],
          &s.f0[0],
          &s.f0[1],
          &s.f0[2],
          &s.roughness,
          &s.normal[0],
          &s.normal[1],
          &s.normal[2],
          &s.ambient_occlusion,
          &s.anisotropy,
          &s.anisotropy_angle};
}

/// Values of as many texels as a vector has lanes: [plane][lane].
template <class F>
using TexelBlock = std::array<std::array<float, lane_count<F>>, svbrdf_planes>;

template <class F>
TexelValues<F> values_of(const TexelBlock<F>& block) {
  const auto at = [&](int plane) { return load_lanes<F>(block[plane].data()); };
  const Vec3<F> n{at(7), at(8), at(9)};
  const F squared = dot(n, n);
  const Vec3<F> up{F(0), F(0), F(1)};
  return {{at(0), at(1), at(2)},
          {at(3), at(4), at(5)},
          at(6),
          select(squared > F(1e-6), n * (F(1) / sqrt(max(squared, F(1e-6)))), up),
          at(10),
          {at(11), at(12)}};
}

}  // namespace kiln

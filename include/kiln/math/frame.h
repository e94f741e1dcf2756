// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "kiln/math/vec.h"

namespace kiln {

/// An orthonormal frame: x tangent, y bitangent, z normal.
template <class F>
struct Frame {
  Vec3<F> x, y, z;

  Vec3<F> to_local(const Vec3<F>& v) const { return {dot(v, x), dot(v, y), dot(v, z)}; }
  Vec3<F> to_world(const Vec3<F>& v) const { return x * v.x + y * v.y + z * v.z; }
};

/// Some frame around the unit normal n, without a singular direction.
/// @source Duff et al. 2017, "Building an Orthonormal Basis, Revisited"
template <class F>
Frame<F> frame_around(const Vec3<F>& n) {
  const F sign = copysign(F(1), n.z);
  const F a = F(-1) / (sign + n.z);
  const F b = n.x * n.y * a;
  return {{F(1) + sign * n.x * n.x * a, sign * b, -sign * n.x}, {b, sign + n.y * n.y * a, -n.y}, n};
}

}  // namespace kiln

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "kiln/math/vec.h"

namespace kiln {

/// A turn of the environment about +Y: a positive angle turns what was at +Z toward +X.
class Turn {
 public:
  explicit Turn(double rotate_deg = 0)
      : sine_(std::sin(rotate_deg * pi / 180)), cosine_(std::cos(rotate_deg * pi / 180)) {}

  /// The direction of the unturned image that is seen at the world direction d.
  template <class F>
  Vec3<F> to_image(const Vec3<F>& d) const {
    const F s = F(static_cast<ScalarOf<F>>(sine_)), c = F(static_cast<ScalarOf<F>>(cosine_));
    return {c * d.x - s * d.z, d.y, fma(s, d.x, c * d.z)};
  }

  /// The world direction in which the direction d of the unturned image is seen.
  template <class F>
  Vec3<F> to_world(const Vec3<F>& d) const {
    const F s = F(static_cast<ScalarOf<F>>(sine_)), c = F(static_cast<ScalarOf<F>>(cosine_));
    return {fma(c, d.x, s * d.z), d.y, c * d.z - s * d.x};
  }

 private:
  double sine_, cosine_;
};

}  // namespace kiln

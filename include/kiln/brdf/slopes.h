// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "kiln/math/vec.h"

namespace kiln {

// What distributions of microfacet normals have in common. A normal m has the slopes
// (-mx / mz, -my / mz); a stretch of the surface by alpha multiplies them.

/// Squared sine of a normal's angle to z; unlike 1 - mz^2 it keeps its digits near the pole.
template <class F>
F sine_squared(const Vec3<F>& wm) {
  return fma(wm.x, wm.x, wm.y * wm.y);
}

/// Logarithm of a squared cosine or sine, of which the complement is given too: whichever is small
/// has the digits.
template <class F>
F log_of_share(F share, F complement) {
  const F small = log(max(share, F(1e-36)));
  const F large = log1p(-min(complement, F(0.75)));
  return select(complement < F(0.5), large, small);
}

/// The unit normal with slopes (-x, -y).
template <class F>
Vec3<F> normal_of_slopes(F x, F y) {
  const F z = F(1) / sqrt(fma(x, x, fma(y, y, F(1))));
  return {x * z, y * z, z};
}

/// The unit normal at azimuth 2 pi u whose squared sine and cosine are given.
template <class F>
Vec3<F> normal_at(F u, F sine_squared, F cosine_squared) {
  const F phi = F(2 * pi) * u;
  const F sine = safe_sqrt(sine_squared);
  return {sine * cos(phi), sine * sin(phi), safe_sqrt(cosine_squared)};
}

/// The one width of a distribution, for models that know only one: sqrt(ax ay).
template <class Distribution>
auto mean_width(const Distribution& distribution) {
  return sqrt(distribution.alpha_x * distribution.alpha_y);
}

}  // namespace kiln

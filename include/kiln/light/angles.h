// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "kiln/math/vec.h"

namespace kiln {

/// Angle of the point (x, y) from the +x axis, in [-1/2, 1/2]; 0 at the origin [turn].
/// @accuracy  float 6e-8 turn; double as std::atan2
template <class F>
F turns_of(F y, F x) {
  if constexpr (std::is_same_v<ScalarOf<F>, double>) {
    return atan2(y, x) * F(0.5 / pi);
  } else {
    // atan(q) / (2 pi q) in powers of q^2 on [0,1], interpolated at Chebyshev points: 1e-8.
    const F ax = abs(x), ay = abs(y);
    const F q = min(ax, ay) / max(max(ax, ay), F(1e-30f));
    const F s = q * q;
    F p = fma(s, F(-0.000725713434f), F(0.00378478708f));
    p = fma(s, p, F(-0.00936304601f));
    p = fma(s, p, F(0.0157067872f));
    p = fma(s, p, F(-0.0222869285f));
    p = fma(s, p, F(0.0317784067f));
    p = fma(s, p, F(-0.0530492275f));
    p = fma(s, p, F(0.159154924f)) * q;
    p = select(ay > ax, F(0.25f) - p, p);
    p = select(x < F(0), F(0.5f) - p, p);
    return copysign(p, y);
  }
}

template <class F>
struct SineCosine {
  F sine, cosine;
};

/// Sine and cosine of an angle; |turns| < 1e3 [turn].
/// @accuracy  float 1.2e-7; double as std::sin
template <class F>
SineCosine<F> sine_cosine_of_turns(F turns) {
  if constexpr (std::is_same_v<ScalarOf<F>, double>) {
    return {sin(turns * F(2 * pi)), cos(turns * F(2 * pi))};
  } else {
    // The nearest quarter turn, and polynomials on the eighth at either side of it, interpolated
    // at Chebyshev points: 3e-9.
    const F quarters = floor(fma(turns, F(4.0f), F(0.5f)));
    const F t = fma(quarters, F(-0.25f), turns);
    const F t2 = t * t;
    const F s = fma(t2, fma(t2, fma(t2, F(-75.4016127f), F(81.5925429f)), F(-41.3416626f)),
                    F(6.28318529f)) *
                t;
    const F c = fma(
        t2,
        fma(t2, fma(t2, fma(t2, F(59.2201687f), F(-85.4428447f)), F(64.9393161f)), F(-19.7392087f)),
        F(1.0f));
    const F quadrant = quarters - F(4.0f) * floor(quarters * F(0.25f));
    const auto odd = abs(quadrant - F(2.0f)) == F(1.0f);
    const F sine = select(odd, c, s), cosine = select(odd, s, c);
    return {select(quadrant >= F(2.0f), -sine, sine),
            select(abs(quadrant - F(1.5f)) < F(1.0f), -cosine, cosine)};
  }
}

/// Lat-long point (u, v) in [0,1]^2 of the unit direction d, as direction_to_latlong but cheaper.
/// @accuracy  float 1.2e-7
template <class F>
Vec2<F> latlong_of(const Vec3<F>& d) {
  const F horizontal = sqrt(fma(d.x, d.x, d.z * d.z));
  return {turns_of(-d.x, d.z) + F(0.5), F(2) * turns_of(horizontal, d.y)};
}

}  // namespace kiln

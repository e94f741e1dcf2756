// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>

#include "kiln/brdf/fresnel.h"

namespace kiln {

/// Exact Fresnel reflectance of a metal with the complex index n - i k, unpolarised.
template <class F>
struct Conductor {
  static constexpr std::string_view name = "conductor";
  static constexpr std::string_view summary = "exact Fresnel reflectance of a metal (n, k)";
  static constexpr std::string_view source = "Fresnel 1823; Born & Wolf 1959";
  static constexpr std::array params = {
      ModelParam{"ior", 0.05, 20, 0.2, "relative index of refraction n"},
      ModelParam{"extinction", 0, 20, 3.9, "extinction coefficient k"}};

  F ior, extinction;

  static Conductor make(const FresnelChannel<F>& channel) {
    return {channel.ior, channel.extinction};
  }

  /// With s^2 = 1 - c^2 and (a + i b)^2 = n^2 - 1 + c^2 - k^2 + 2 i n k,
  ///
  ///     Rs = ((c - a)^2 + b^2) / ((c + a)^2 + b^2)
  ///     Rp = Rs ((a c - s^2)^2 + (b c)^2) / ((a c + s^2)^2 + (b c)^2),   F = (Rs + Rp) / 2
  ///
  /// All sums of squares: nothing cancels. The smaller of a^2 and b^2 is found from a b = n k.
  F eval(F cosine) const {
    const F c = clamp(cosine, F(0), F(1));
    const F s2 = (F(1) - c) * (F(1) + c);
    const F nk = ior * extinction;
    const F contrast = (ior - F(1)) * (ior + F(1));
    const F real = fma(c, c, contrast) - extinction * extinction;
    const F modulus = sqrt(fma(real, real, F(4) * nk * nk));
    const F greater = max(F(0.5) * (modulus + abs(real)), F(1e-30));
    const F lesser = nk * nk / greater;
    const F a2 = select(real > F(0), greater, lesser), b2 = select(real > F(0), lesser, greater);
    const F a = sqrt(a2);
    const F rs = fma(c - a, c - a, b2) / fma(c + a, c + a, b2);
    const F away = fma(a, c, -s2), toward = fma(a, c, s2), bc2 = b2 * c * c;
    const F rp = rs * fma(away, away, bc2) / max(fma(toward, toward, bc2), F(1e-30));
    return F(0.5) * (rs + rp);
  }

  /// Average over the hemisphere of directions, by quadrature.
  /// @accuracy 1e-6 where k >= 1 or n >= 1.1
  F average() const { return fresnel_average<F>(*this); }
};

}  // namespace kiln

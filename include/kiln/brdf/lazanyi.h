// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>

#include "kiln/brdf/fresnel.h"

namespace kiln {

/// Schlick's form of a metal's n and k, less a fitted error term:
///
///     F = ((n - 1)^2 + 4 n (1 - c)^5 + k^2) / ((n + 1)^2 + k^2) - a c (1 - c)^p
///
/// clamped to [0,1].
/// @source Lazanyi and Szirmay-Kalos 2005, "Fresnel Term Approximations for Metals"
template <class F>
struct Lazanyi {
  static constexpr std::string_view name = "lazanyi";
  static constexpr std::string_view summary = "Schlick of n and k less a fitted error term";
  static constexpr std::string_view source = "Lazanyi & Szirmay-Kalos 2005";
  static constexpr std::array params = {
      ior_param, extinction_param, ModelParam{"dip", -20, 20, 0, "a, scale of the error term"},
      ModelParam{"exponent", 1, 20, 6, "p, exponent of the error term"}};

  F ior, extinction, dip, exponent;

  static Lazanyi make(const FresnelChannel<F>& channel) {
    return {channel.ior, channel.extinction, channel.dip, channel.exponent};
  }

  F eval(F cosine) const {
    const F c = clamp(cosine, F(0), F(1)), rest = F(1) - c;
    const F k2 = extinction * extinction;
    const F schlick =
        (fma(F(4) * ior, grazing_weight(c), square(ior - F(1))) + k2) / (square(ior + F(1)) + k2);
    const F power = exp(exponent * log(max(rest, F(1e-30))));
    return clamp(fma(-dip * c, power, schlick), F(0), F(1));
  }

  /// Average over the hemisphere of directions, by quadrature; without clamping
  /// (that of Schlick's part) - 4 a / ((p + 1)(p + 2)(p + 3)).
  /// @accuracy 1e-6 where nothing was clamped, else 1e-3
  F average() const { return fresnel_average<F>(*this); }
};

}  // namespace kiln

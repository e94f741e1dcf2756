// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>

#include "kiln/brdf/model_param.h"
#include "kiln/brdf/slopes.h"

namespace kiln {

/// The Charlie distribution of sheen: fibres that stand up, most normals near the horizon.
///
/// Its alpha is no width of slopes, and callers decide what it is: glTF and Filament take
/// alpha = roughness^2, MaterialX and the paper alpha = roughness.
template <class F>
struct Charlie {
  static constexpr std::string_view name = "charlie";
  static constexpr std::string_view summary =
      "Charlie sheen; alpha is roughness^2 (glTF, Filament) or roughness (paper, MaterialX)";
  static constexpr std::string_view source = "Estevez & Kulla 2017";
  static constexpr std::array params = {
      ModelParam{"alpha", 1e-4, 1, 0.25, "inverse of the exponent of the sine"}};
  static constexpr bool anisotropic = false;
  static constexpr bool alpha_is_width = false;
  static constexpr bool has_lambda = false;
  static constexpr bool exact_lambda = false;

  F alpha_x, alpha_y;

  /// Of two widths, their geometric mean.
  static Charlie make(F alpha_x, F alpha_y, F) { return isotropic(sqrt(alpha_x * alpha_y)); }
  static Charlie isotropic(F alpha) { return {alpha, alpha}; }

  /// Density of microfacet normals.
  ///
  ///     D(m) = (2 + 1/a) / (2 pi) sin(theta)^(1/a)                       if mz > 0, else 0
  ///
  /// @return    [1/sr], >= 0; integrates to 1 against wm.z over the hemisphere
  /// @valid     a in [1e-4, 1]
  /// @accuracy  float vs double: relative error (8 + 4 x) ulp, x = -ln(sin) / a
  F D(const Vec3<F>& wm) const {
    const F half_exponent = F(0.5) / alpha_x;
    const F power = half_exponent * log_of_share(sine_squared(wm), wm.z * wm.z);
    return select(wm.z > F(0), (F(1) + half_exponent) * F(1 / pi) * exp(power), F(0));
  }

  /// A microfacet normal with density D(wm) wm.z: sin = u^(a / (2 a + 1)).
  /// @param u  uniform in (0,1)^2
  Vec3<F> sample(const Vec2<F>& u) const {
    const F power = F(2) * alpha_x / fma(F(2), alpha_x, F(1)) * log(u.y);
    return normal_at(u.x, exp(power), -expm1(power));
  }
};

}  // namespace kiln

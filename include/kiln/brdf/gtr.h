// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>

#include "kiln/brdf/ggx.h"

namespace kiln {

/// Generalised Trowbridge-Reitz: GGX with its exponent free. Exponent 2 is GGX, 1 is Berry's, with
/// the long tail of clearcoats. Isotropic.
template <class F>
struct Gtr {
  static constexpr std::string_view name = "gtr";
  static constexpr std::string_view summary =
      "generalised Trowbridge-Reitz normals of any tail; Lambda borrowed from GGX";
  static constexpr std::string_view source = "Burley 2012; Berry 1923 (shape 1)";
  static constexpr double default_shape = 1;
  static constexpr std::array params = {
      alpha_param, ModelParam{"shape", 0.5, 10, default_shape, "exponent; 2 is GGX"}};
  static constexpr bool anisotropic = false;
  static constexpr bool alpha_is_width = true;
  static constexpr bool has_lambda = true;
  static constexpr bool exact_lambda = false;

  F alpha_x, alpha_y;
  F shape;  ///< g

  /// Of two widths, their geometric mean.
  static Gtr make(F alpha_x, F alpha_y, F shape) {
    const F alpha = sqrt(alpha_x * alpha_y);
    return {alpha, alpha, shape};
  }
  static Gtr isotropic(F alpha) { return {alpha, alpha, F(default_shape)}; }

  /// Density of microfacet normals.
  ///
  ///     D(m) = c / (1 - (1 - a^2) mz^2)^g                                if mz > 0, else 0
  ///     c    = (1 - a^2)(g - 1) / (pi (a^(2 (1 - g)) - 1)),   (1 - a^2) / (-pi ln a^2) for g = 1
  ///
  /// With r(x) = (e^x - 1) / x and y = -ln a^2 that is
  ///
  ///     D(m) = r(-y) / (pi a^2 r((1 - g) y)) e^-g,   e = (mx^2 + my^2) / a^2 + mz^2
  ///
  /// where g = 1 and a = 1 are no special cases.
  ///
  /// @return    [1/sr], >= 0; integrates to 1 against wm.z over the hemisphere
  /// @valid     alpha in [1e-4, 1], g in [0.5, 10]
  /// @accuracy  float vs double: relative error (16 + 4 g ln e) ulp
  F D(const Vec3<F>& wm) const {
    const F a2 = alpha_x * alpha_x;
    const F y = minus_log_alpha2();
    const F e = fma(wm.z, wm.z, sine_squared(wm) / a2);
    const F peak = relative_growth(-y) / (F(pi) * a2 * relative_growth((F(1) - shape) * y));
    return select(wm.z > F(0), peak * exp(-shape * log(e)), F(0));
  }

  /// Smith's Lambda of GGX of the same alpha, as is customary.
  F lambda(const Vec3<F>& w) const { return ggx().lambda(w); }
  F stretched_length(const Vec3<F>& w) const { return ggx().stretched_length(w); }

  /// A microfacet normal with density D(wm) wm.z: with e as above,
  /// ln e = ln(1 + u (e^((1 - g) y) - 1)) / (1 - g) and the squared sine is (e - 1) / (1/a^2 - 1).
  /// @param u  uniform in (0,1)^2
  Vec3<F> sample(const Vec2<F>& u) const {
    const F y = minus_log_alpha2();
    const F k = away_from_zero(F(1) - shape);
    const F log_e = log1p(u.y * expm1(k * y)) / k;
    const F s2 = min(expm1(log_e) / expm1(y), F(1));
    return normal_at(u.x, s2, F(1) - s2);
  }

 private:
  Ggx<F> ggx() const { return {alpha_x, alpha_y}; }

  static F away_from_zero(F x) { return select(abs(x) < F(1e-12), F(1e-12), x); }

  /// (e^x - 1) / x, 1 at 0.
  static F relative_growth(F x) {
    const F safe = away_from_zero(x);
    return expm1(safe) / safe;
  }

  /// y = -ln a^2, kept above 0 so that quotients of it are defined at a = 1.
  F minus_log_alpha2() const { return max(F(-2) * log(alpha_x), F(1e-12)); }
};

}  // namespace kiln

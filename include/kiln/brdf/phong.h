// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>

#include "kiln/brdf/beckmann.h"

namespace kiln {

/// The Blinn-Phong distribution of microfacet normals, normalised against the cosine, with the
/// exponents n = 2 / alpha^2 - 2 along the two axes.
template <class F>
struct Phong {
  static constexpr std::string_view name = "phong";
  static constexpr std::string_view summary =
      "Blinn-Phong microfacet normals, exponent 2 / alpha^2 - 2; Lambda borrowed from Beckmann";
  static constexpr std::string_view source = "Blinn 1977; Walter et al. 2007";
  static constexpr std::array params = {alpha_x_param, alpha_y_param};
  static constexpr bool anisotropic = true;
  static constexpr bool alpha_is_width = true;
  static constexpr bool has_lambda = true;
  static constexpr bool exact_lambda = false;

  F alpha_x, alpha_y;

  static Phong make(F alpha_x, F alpha_y, F) { return {alpha_x, alpha_y}; }
  static Phong isotropic(F alpha) { return {alpha, alpha}; }

  /// Density of microfacet normals.
  ///
  ///     D(m) = sqrt((nx + 2)(ny + 2)) / (2 pi) mz^e,   e = (nx mx^2 + ny my^2) / (mx^2 + my^2)
  ///
  /// if mz > 0, else 0. The power is exp(e/2 ln mz^2) with the logarithm taken from the sine near
  /// the pole, where exponents are large.
  ///
  /// @return    [1/sr], >= 0; integrates to 1 against wm.z over the hemisphere
  /// @valid     alpha_x, alpha_y in [1e-4, 1]
  /// @accuracy  float vs double: relative error (8 + 4 x) ulp, x = -e ln mz
  F D(const Vec3<F>& wm) const {
    const F x = wm.x / alpha_x, y = wm.y / alpha_y;
    const F s2 = sine_squared(wm), z2 = wm.z * wm.z;
    const F half_exponent = max(fma(x, x, y * y) - s2, F(0)) / max(s2, F(1e-36));
    const F density = exp(half_exponent * log_of_share(z2, s2)) / (F(pi) * alpha_x * alpha_y);
    return select(wm.z > F(0), density, F(0));
  }

  /// Smith's Lambda of the Beckmann distribution of the same alpha, as is customary.
  F lambda(const Vec3<F>& w) const { return Beckmann<F>{alpha_x, alpha_y}.lambda(w); }

  /// A microfacet normal with density D(wm) wm.z: the azimuth is that of a stretched circle, and
  /// mz^2 = u^(l^2) with l the length of the stretched radius.
  /// @param u  uniform in (0,1)^2
  Vec3<F> sample(const Vec2<F>& u) const {
    const F phi = F(2 * pi) * u.x;
    const F x = alpha_x * cos(phi), y = alpha_y * sin(phi);
    const F stretch2 = fma(x, x, y * y);
    const F exponent = stretch2 * log(u.y);
    const F sine = safe_sqrt(-expm1(exponent)) / sqrt(stretch2);
    return {x * sine, y * sine, exp(F(0.5) * exponent)};
  }
};

}  // namespace kiln

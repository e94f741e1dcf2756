// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>

#include "kiln/brdf/model_param.h"
#include "kiln/brdf/slopes.h"

namespace kiln {

/// Chebyshev coefficients, in s = (a - 3) / (a + 3), of (1 + 2 a^2)(1 - sqrt(pi) a erfcx(a)) with
/// erfcx(a) = exp(a^2) erfc(a): the tail of a Gaussian without its exponential, made flat.
/// @accuracy 26 terms 1e-16, 14 terms 2e-8
inline constexpr std::array<double, 26> gaussian_tail_terms = {
    0.898302042774562314,     0.112627852257613641,     0.0357130585294817476,
    -0.087265787631584874,    0.0594534792148791024,    -0.0243856009161839682,
    0.00652277060088226796,   -0.00100565062492973163,  0.0000127946209627468282,
    0.0000297848848222102376, -4.34782672857820393e-6,  -6.0933561114384401e-7,
    2.10743212980585054e-7,   1.16527595713272265e-8,   -9.03807477573887249e-9,
    -3.03076142500669242e-10, 3.98260481264294237e-10,  1.75775735330955389e-11,
    -1.82363902171903419e-11, -1.50400973501810779e-12, 8.31635144597930802e-13,
    1.25746664974895486e-13,  -3.45815775017862847e-14, -9.4768166784169485e-15,
    1.03909031821776575e-15,  6.30501026616793496e-16};

/// Smith's Lambda of Gaussian slopes, a = 1 / (alpha tan theta).
///
///     Lambda = exp(-a^2) / (2 a sqrt(pi)) - erfc(a) / 2
///            = exp(-a^2) (1 - sqrt(pi) a erfcx(a)) / (2 a sqrt(pi))
///
/// The difference cancels for large a; the bracket is positive and smooth and is summed as a
/// series.
///
/// @valid    a >= 0; clamped to [1e-15, 1e4]
/// @accuracy relative error at most (4 + a^2) ulp
/// @source   Smith 1967; Heitz 2014
template <class F>
F gaussian_lambda(F a) {
  constexpr int terms = sizeof(ScalarOf<F>) == sizeof(float) ? 14 : 26;
  const F x = min(max(a, F(1e-15)), F(1e4));
  const F s = (x - F(3)) / (x + F(3)), twice = s + s;
  F sum = F(gaussian_tail_terms[terms - 1]), before = F(0);
  for (int k = terms - 2; k > 0; --k) {  // Clenshaw
    const F next = fma(twice, sum, F(gaussian_tail_terms[k]) - before);
    before = sum;
    sum = next;
  }
  const F flat = fma(s, sum, F(gaussian_tail_terms[0]) - before);
  const F x2 = x * x;
  return exp(-x2) * flat / (F(3.5449077018110320546) * x * fma(F(2), x2, F(1)));
}

/// The Beckmann distribution of microfacet normals: Gaussian slopes of variance alpha^2 / 2.
template <class F>
struct Beckmann {
  static constexpr std::string_view name = "beckmann";
  static constexpr std::string_view summary = "Beckmann microfacet normals, Gaussian slopes";
  static constexpr std::string_view source =
      "Beckmann & Spizzichino 1963; Walter et al. 2007; Heitz 2014";
  static constexpr std::array params = {alpha_x_param, alpha_y_param};
  static constexpr bool anisotropic = true;
  static constexpr bool alpha_is_width = true;
  static constexpr bool has_lambda = true;
  static constexpr bool exact_lambda = true;

  F alpha_x, alpha_y;

  static Beckmann make(F alpha_x, F alpha_y, F) { return {alpha_x, alpha_y}; }
  static Beckmann isotropic(F alpha) { return {alpha, alpha}; }

  /// Density of microfacet normals.
  ///
  ///     D(m) = exp(-((mx/ax)^2 + (my/ay)^2) / mz^2) / (pi ax ay mz^4)      if mz > 0, else 0
  ///
  /// @return    [1/sr], >= 0; integrates to 1 against wm.z over the hemisphere
  /// @valid     alpha_x, alpha_y in [1e-4, 1]
  /// @accuracy  float vs double: relative error (8 + 2 x) ulp, x the exponent
  F D(const Vec3<F>& wm) const {
    const F x = wm.x / alpha_x, y = wm.y / alpha_y;
    const F z2 = max(wm.z * wm.z, F(1e-12));
    const F density = exp(-fma(x, x, y * y) / z2) / (F(pi) * alpha_x * alpha_y * z2 * z2);
    return select(wm.z > F(0), density, F(0));
  }

  /// Smith's Lambda, see gaussian_lambda; for w.z <= 0 that of a grazing direction.
  F lambda(const Vec3<F>& w) const {
    const F x = alpha_x * w.x, y = alpha_y * w.y;
    return gaussian_lambda(max(w.z, F(0)) / max(sqrt(fma(x, x, y * y)), F(1e-15)));
  }

  /// A microfacet normal with density D(wm) wm.z: t^2 = -ln(1 - u) in stretched slopes.
  /// @param u  uniform in (0,1)^2
  /// @source   Walter et al. 2007
  Vec3<F> sample(const Vec2<F>& u) const {
    const F t = sqrt(-log1p(-u.y)), phi = F(2 * pi) * u.x;
    return normal_of_slopes(alpha_x * t * cos(phi), alpha_y * t * sin(phi));
  }
};

}  // namespace kiln

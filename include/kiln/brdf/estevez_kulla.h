// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>
#include <type_traits>

#include "kiln/brdf/charlie.h"

namespace kiln {

/// Smith's correlated masking with the Lambda fitted to the Charlie distribution:
///
///     Lambda(mu) = exp(L(mu)) if mu < 1/2, else exp(2 L(1/2) - L(1 - mu))
///     L(x) = a / (1 + b x^c) + d x + e,   p = (1 - alpha)^2 p0 + (1 - (1 - alpha)^2) p1
///
/// @source Estevez and Kulla 2017, "Production Friendly Microfacet Sheen BRDF"
template <class F>
struct EstevezKulla {
  static constexpr std::string_view name = "estevez-kulla";
  static constexpr std::string_view summary = "correlated masking with Charlie's fitted Lambda";
  static constexpr std::string_view source = "Estevez & Kulla 2017";
  template <class Distribution>
  static constexpr bool fits = std::is_same_v<Distribution, Charlie<F>>;
  static constexpr bool one_sided = true;
  static constexpr double kinked_below = 2;  // from every view

  /// @valid mu in [0,1], alpha in [0,1]; clamped
  static F lambda(F alpha, F mu) {
    const F smooth = square(F(1) - clamp(alpha, F(0), F(1)));
    const F x = clamp(mu, F(0), F(1));
    const F reflected = min(x, F(1) - x);
    const F level = exponent(smooth, reflected);
    return exp(select(x < F(0.5), level, F(2) * exponent(smooth, F(0.5)) - level));
  }

  template <class Distribution>
  static F G1(const Distribution& distribution, const Vec3<F>& w, const Vec3<F>&) {
    return F(1) / (F(1) + lambda(distribution.alpha_x, w.z));
  }

  template <class Distribution>
  static F G2(const Distribution& distribution, const Vec3<F>& wo, const Vec3<F>& wi,
              const Vec3<F>&) {
    const F alpha = distribution.alpha_x;
    return F(1) / (F(1) + lambda(alpha, wo.z) + lambda(alpha, wi.z));
  }

  /// @valid mu_o, mu_i > 0
  template <class Distribution>
  static F visibility(const Distribution& distribution, const Vec3<F>& wo, const Vec3<F>& wi,
                      const Vec3<F>& wm) {
    return F(0.25) * G2(distribution, wo, wi, wm) / (wo.z * wi.z);
  }

 private:
  static constexpr std::array smooth_terms = {25.3245, 3.32435, 0.16801, -1.27393, -4.85967};
  static constexpr std::array rough_terms = {21.5473, 3.82987, 0.19823, -1.97760, -4.32054};

  static F term(F smooth, int k) { return lerp(F(rough_terms[k]), F(smooth_terms[k]), smooth); }

  static F exponent(F smooth, F x) {
    const F power = exp(term(smooth, 2) * log(max(x, F(1e-30))));
    return term(smooth, 0) / fma(term(smooth, 1), power, F(1)) +
           fma(term(smooth, 3), x, term(smooth, 4));
  }
};

}  // namespace kiln

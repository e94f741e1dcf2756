// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "kiln/brdf/ggx.h"

namespace kiln {

/// Smith's masking and shadowing, correlated in height: G2 = 1 / (1 + Lambda(wo) + Lambda(wi)).
/// @source Heitz 2014, "Understanding the Masking-Shadowing Function"
template <class F>
struct SmithCorrelated {
  static constexpr std::string_view name = "smith-correlated";
  static constexpr std::string_view summary = "Smith masking, correlated in height, exact";
  static constexpr std::string_view source = "Smith 1967; Heitz 2014";

  template <class Distribution>
  static F G1(const Distribution& distribution, const Vec3<F>& w) {
    return F(1) / (F(1) + distribution.lambda(w));
  }

  template <class Distribution>
  static F G2(const Distribution& distribution, const Vec3<F>& wo, const Vec3<F>& wi) {
    return F(1) / (F(1) + distribution.lambda(wo) + distribution.lambda(wi));
  }

  /// G2 / (4 mu_o mu_i) without a quotient of small numbers. For GGX,
  /// 1 + Lambda(w) = (|stretched w| / mu + 1) / 2, hence
  ///
  ///     V = 1 / (2 (mu_o |stretched wi| + mu_i |stretched wo|))
  ///
  /// @valid mu_o, mu_i > 0
  static F visibility(const Ggx<F>& ggx, const Vec3<F>& wo, const Vec3<F>& wi) {
    return F(0.5) / fma(wo.z, ggx.stretched_length(wi), wi.z * ggx.stretched_length(wo));
  }
};

}  // namespace kiln

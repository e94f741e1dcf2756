// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "kiln/brdf/slopes.h"

namespace kiln {

/// Masking of cloth: G2 = mu_o mu_i / (mu_o + mu_i - mu_o mu_i). With a sheen distribution of small
/// alpha it reflects more than it receives at grazing angles.
/// @source Neubelt and Pettineo 2013, "Crafting a Next-Gen Material Pipeline for The Order: 1886"
template <class F>
struct Neubelt {
  static constexpr std::string_view name = "neubelt";
  static constexpr std::string_view summary = "masking of cloth; gains energy at grazing angles";
  static constexpr std::string_view source = "Neubelt & Pettineo 2013";
  template <class Distribution>
  static constexpr bool fits = true;
  static constexpr bool one_sided = false;

  template <class Distribution>
  static F G2(const Distribution&, const Vec3<F>& wo, const Vec3<F>& wi, const Vec3<F>&) {
    const F mu_o = max(wo.z, F(0)), mu_i = max(wi.z, F(0));
    return mu_o * mu_i / max(either(mu_o, mu_i), F(1e-30));
  }

  /// @valid max(mu_o, mu_i) > 0
  template <class Distribution>
  static F visibility(const Distribution&, const Vec3<F>& wo, const Vec3<F>& wi, const Vec3<F>&) {
    return F(0.25) / either(wo.z, wi.z);
  }

 private:
  // mu_o + mu_i - mu_o mu_i, as a sum of positive terms.
  static F either(F mu_o, F mu_i) {
    const F greater = max(mu_o, mu_i), lesser = min(mu_o, mu_i);
    return fma(lesser, F(1) - greater, greater);
  }
};

/// Neubelt's masking with its visibility never above 1, as several sheen shaders have it.
/// @source Neubelt and Pettineo 2013; the clamp from the glTF sample viewer's sheen
template <class F>
struct NeubeltClamped {
  static constexpr std::string_view name = "neubelt-clamped";
  static constexpr std::string_view summary = "masking of cloth, its visibility at most 1";
  static constexpr std::string_view source = "Neubelt & Pettineo 2013; glTF sample viewer";
  template <class Distribution>
  static constexpr bool fits = true;
  static constexpr bool one_sided = false;
  static constexpr double kinked_below = 0.25;  // the clamp acts where both directions graze

  template <class Distribution>
  static F G2(const Distribution& distribution, const Vec3<F>& wo, const Vec3<F>& wi,
              const Vec3<F>& wm) {
    const F plain = Neubelt<F>::G2(distribution, wo, wi, wm);
    return min(plain, F(4) * max(wo.z, F(0)) * max(wi.z, F(0)));
  }

  /// @valid max(mu_o, mu_i) > 0
  template <class Distribution>
  static F visibility(const Distribution& distribution, const Vec3<F>& wo, const Vec3<F>& wi,
                      const Vec3<F>& wm) {
    return min(Neubelt<F>::visibility(distribution, wo, wi, wm), F(1));
  }
};

}  // namespace kiln

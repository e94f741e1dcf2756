// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "kiln/brdf/slopes.h"

namespace kiln {

/// Hammon's short form of Smith's correlated masking of GGX:
///
///     V = 1 / (2 lerp(2 mu_o mu_i, mu_o + mu_i, alpha))
///
/// Exact for alpha = 0 and 1. G1 is G2 with the other direction along the normal.
/// @source Hammon 2017, "PBR Diffuse Lighting for GGX+Smith Microsurfaces"
template <class F>
struct HammonMasking {
  static constexpr std::string_view name = "hammon";
  static constexpr std::string_view summary = "Hammon's approximation of correlated Smith for GGX";
  static constexpr std::string_view source = "Hammon 2017";
  template <class Distribution>
  static constexpr bool fits = Distribution::alpha_is_width;
  static constexpr bool one_sided = true;

  template <class Distribution>
  static F G1(const Distribution& distribution, const Vec3<F>& w, const Vec3<F>& wm) {
    return G2(distribution, w, Vec3<F>{F(0), F(0), F(1)}, wm);
  }

  template <class Distribution>
  static F G2(const Distribution& distribution, const Vec3<F>& wo, const Vec3<F>& wi,
              const Vec3<F>&) {
    const F mu_o = max(wo.z, F(0)), mu_i = max(wi.z, F(0));
    return F(2) * mu_o * mu_i / max(blend(distribution, mu_o, mu_i), F(1e-30));
  }

  /// @valid mu_o, mu_i > 0
  template <class Distribution>
  static F visibility(const Distribution& distribution, const Vec3<F>& wo, const Vec3<F>& wi,
                      const Vec3<F>&) {
    return F(0.5) / blend(distribution, wo.z, wi.z);
  }

 private:
  // Both weights are positive, so the sum keeps its digits.
  template <class Distribution>
  static F blend(const Distribution& distribution, F mu_o, F mu_i) {
    const F alpha = mean_width(distribution);
    return fma(alpha, mu_o + mu_i, F(2) * (F(1) - alpha) * mu_o * mu_i);
  }
};

}  // namespace kiln

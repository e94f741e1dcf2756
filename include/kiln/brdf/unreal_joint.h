// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "kiln/brdf/slopes.h"

namespace kiln {

/// Unreal's approximation of correlated Smith masking of GGX, alpha in place of a square root:
///
///     V = 1 / (2 (mu_i (mu_o (1 - alpha) + alpha) + mu_o (mu_i (1 - alpha) + alpha)))
///
/// As a function it is Hammon's. G1 is G2 with the other direction along the normal.
/// @source Karis 2013; Vis_SmithJointApprox of Unreal Engine 4
template <class F>
struct UnrealJoint {
  static constexpr std::string_view name = "unreal-joint";
  static constexpr std::string_view summary = "Unreal's approximation of correlated Smith for GGX";
  static constexpr std::string_view source = "Unreal Engine 4, Vis_SmithJointApprox";
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
    return F(2) * mu_o * mu_i / max(sum(distribution, mu_o, mu_i), F(1e-30));
  }

  /// @valid mu_o, mu_i > 0
  template <class Distribution>
  static F visibility(const Distribution& distribution, const Vec3<F>& wo, const Vec3<F>& wi,
                      const Vec3<F>&) {
    return F(0.5) / sum(distribution, wo.z, wi.z);
  }

 private:
  template <class Distribution>
  static F sum(const Distribution& distribution, F mu_o, F mu_i) {
    const F alpha = mean_width(distribution), rest = F(1) - alpha;
    return fma(mu_i, fma(mu_o, rest, alpha), mu_o * fma(mu_i, rest, alpha));
  }
};

}  // namespace kiln

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "kiln/brdf/slopes.h"

namespace kiln {

/// Masking of a surface made of long symmetric V-grooves; knows no roughness and has kinks.
///
///     G2 = min(1, 2 mu_h mu_o / c, 2 mu_h mu_i / c),   c = wo.wm
///
/// @source Torrance and Sparrow 1967; Cook and Torrance 1982
template <class F>
struct VCavity {
  static constexpr std::string_view name = "v-cavity";
  static constexpr std::string_view summary = "masking of V-shaped grooves (Cook-Torrance)";
  static constexpr std::string_view source = "Torrance & Sparrow 1967; Cook & Torrance 1982";
  template <class Distribution>
  static constexpr bool fits = true;
  static constexpr bool one_sided = true;
  static constexpr double kinked_below = 2;  // from every view

  template <class Distribution>
  static F G1(const Distribution&, const Vec3<F>& w, const Vec3<F>& wm) {
    return min(F(1), F(2) * wm.z * max(w.z, F(0)) / max(dot(w, wm), F(1e-30)));
  }

  template <class Distribution>
  static F G2(const Distribution&, const Vec3<F>& wo, const Vec3<F>& wi, const Vec3<F>& wm) {
    const F lower = max(min(wo.z, wi.z), F(0));
    return min(F(1), F(2) * wm.z * lower / max(dot(wo, wm), F(1e-30)));
  }

  /// @valid mu_o, mu_i > 0
  template <class Distribution>
  static F visibility(const Distribution&, const Vec3<F>& wo, const Vec3<F>& wi,
                      const Vec3<F>& wm) {
    const F open = F(0.25) / (wo.z * wi.z);
    const F groove = F(0.5) * wm.z / (max(dot(wo, wm), F(1e-30)) * max(wo.z, wi.z));
    return min(open, groove);
  }
};

}  // namespace kiln

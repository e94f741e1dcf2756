// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "kiln/brdf/slopes.h"

namespace kiln {

/// Kelemen's short form of the V-grooves: G2 = mu_o mu_i / c^2 with c = wo.wm; at most mu_h^2.
/// @source Kelemen and Szirmay-Kalos 2001
template <class F>
struct Kelemen {
  static constexpr std::string_view name = "kelemen";
  static constexpr std::string_view summary = "masking mu_o mu_i / (wo.wm)^2";
  static constexpr std::string_view source = "Kelemen & Szirmay-Kalos 2001";
  template <class Distribution>
  static constexpr bool fits = true;
  static constexpr bool one_sided = false;
  static constexpr double kinked_below = 2;  // from every view

  template <class Distribution>
  static F G2(const Distribution& distribution, const Vec3<F>& wo, const Vec3<F>& wi,
              const Vec3<F>& wm) {
    return F(4) * max(wo.z, F(0)) * max(wi.z, F(0)) * visibility(distribution, wo, wi, wm);
  }

  template <class Distribution>
  static F visibility(const Distribution&, const Vec3<F>& wo, const Vec3<F>&, const Vec3<F>& wm) {
    return F(0.25) / max(square(dot(wo, wm)), F(1e-30));
  }
};

}  // namespace kiln

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "kiln/brdf/slopes.h"

namespace kiln {

/// Neumann's masking: G2 = mu_o mu_i / max(mu_o, mu_i). A mirror reflects mu instead of 1.
/// @source Neumann, Neumann and Szirmay-Kalos 1999
template <class F>
struct Neumann {
  static constexpr std::string_view name = "neumann";
  static constexpr std::string_view summary = "masking min(mu_o, mu_i)";
  static constexpr std::string_view source = "Neumann, Neumann & Szirmay-Kalos 1999";
  template <class Distribution>
  static constexpr bool fits = true;
  static constexpr bool one_sided = false;
  static constexpr double kinked_below = 2;  // from every view

  template <class Distribution>
  static F G2(const Distribution&, const Vec3<F>& wo, const Vec3<F>& wi, const Vec3<F>&) {
    return max(min(wo.z, wi.z), F(0));
  }

  /// @valid max(mu_o, mu_i) > 0
  template <class Distribution>
  static F visibility(const Distribution&, const Vec3<F>& wo, const Vec3<F>& wi, const Vec3<F>&) {
    return F(0.25) / max(wo.z, wi.z);
  }
};

}  // namespace kiln

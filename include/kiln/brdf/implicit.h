// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "kiln/brdf/slopes.h"

namespace kiln {

/// The masking that cancels the denominator of the microfacet model: G2 = mu_o mu_i. Dark.
/// @source Hoffman 2010
template <class F>
struct Implicit {
  static constexpr std::string_view name = "implicit";
  static constexpr std::string_view summary = "masking mu_o mu_i: what is left without any";
  static constexpr std::string_view source = "Hoffman 2010";
  template <class Distribution>
  static constexpr bool fits = true;
  static constexpr bool one_sided = true;

  template <class Distribution>
  static F G1(const Distribution&, const Vec3<F>& w, const Vec3<F>&) {
    return max(w.z, F(0));
  }

  template <class Distribution>
  static F G2(const Distribution&, const Vec3<F>& wo, const Vec3<F>& wi, const Vec3<F>&) {
    return max(wo.z, F(0)) * max(wi.z, F(0));
  }

  template <class Distribution>
  static F visibility(const Distribution&, const Vec3<F>&, const Vec3<F>&, const Vec3<F>&) {
    return F(0.25);
  }
};

}  // namespace kiln

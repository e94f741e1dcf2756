// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "kiln/brdf/slopes.h"

namespace kiln {

// A masking model says how much of the microfacets that face a direction other microfacets hide.
// G1 is for one direction w with w.wm > 0, G2 for two, both in [0,1]; `visibility` is
// G2 / (4 mu_o mu_i) [1], written so that no small numbers are divided by each other. `fits` says
// for which distributions a model has what it needs, `one_sided` whether there is a G1,
// `kinked_below`, if it is there, under which n.v the formula has kinks in wi (2: everywhere).

/// Smith's masking and shadowing, correlated in height: G2 = 1 / (1 + Lambda(wo) + Lambda(wi)).
/// @source Heitz 2014, "Understanding the Masking-Shadowing Function"
template <class F>
struct SmithCorrelated {
  static constexpr std::string_view name = "smith-correlated";
  static constexpr std::string_view summary = "Smith masking, correlated in height, exact";
  static constexpr std::string_view source = "Smith 1967; Heitz 2014";
  template <class Distribution>
  static constexpr bool fits = Distribution::has_lambda;
  static constexpr bool one_sided = true;

  template <class Distribution>
  static F G1(const Distribution& distribution, const Vec3<F>& w, const Vec3<F>&) {
    return F(1) / (F(1) + distribution.lambda(w));
  }

  template <class Distribution>
  static F G2(const Distribution& distribution, const Vec3<F>& wo, const Vec3<F>& wi,
              const Vec3<F>&) {
    return F(1) / (F(1) + distribution.lambda(wo) + distribution.lambda(wi));
  }

  /// For GGX, 1 + Lambda(w) = (|stretched w| / mu + 1) / 2, hence
  ///
  ///     V = 1 / (2 (mu_o |stretched wi| + mu_i |stretched wo|))
  ///
  /// @valid mu_o, mu_i > 0
  template <class Distribution>
  static F visibility(const Distribution& distribution, const Vec3<F>& wo, const Vec3<F>& wi,
                      const Vec3<F>&) {
    if constexpr (requires { distribution.stretched_length(wo); }) {
      return F(0.5) /
             fma(wo.z, distribution.stretched_length(wi), wi.z * distribution.stretched_length(wo));
    } else {
      return F(0.25) / (wo.z * wi.z * (F(1) + distribution.lambda(wo) + distribution.lambda(wi)));
    }
  }
};

/// Smith's masking and shadowing as if independent: G2 = G1(wo) G1(wi). Too dark at grazing angles.
/// @source Smith 1967; Walter et al. 2007
template <class F>
struct SmithSeparable {
  static constexpr std::string_view name = "smith-separable";
  static constexpr std::string_view summary = "Smith masking times shadowing, uncorrelated";
  static constexpr std::string_view source = "Smith 1967; Walter et al. 2007";
  template <class Distribution>
  static constexpr bool fits = Distribution::has_lambda;
  static constexpr bool one_sided = true;

  template <class Distribution>
  static F G1(const Distribution& distribution, const Vec3<F>& w, const Vec3<F>&) {
    return F(1) / (F(1) + distribution.lambda(w));
  }

  template <class Distribution>
  static F G2(const Distribution& distribution, const Vec3<F>& wo, const Vec3<F>& wi,
              const Vec3<F>&) {
    return F(1) / ((F(1) + distribution.lambda(wo)) * (F(1) + distribution.lambda(wi)));
  }

  /// For GGX, V = 1 / ((mu_o + |stretched wo|)(mu_i + |stretched wi|)).
  /// @valid mu_o, mu_i > 0
  template <class Distribution>
  static F visibility(const Distribution& distribution, const Vec3<F>& wo, const Vec3<F>& wi,
                      const Vec3<F>&) {
    if constexpr (requires { distribution.stretched_length(wo); }) {
      return F(1) / ((wo.z + distribution.stretched_length(wo)) *
                     (wi.z + distribution.stretched_length(wi)));
    } else {
      return F(0.25) / ((wo.z * (F(1) + distribution.lambda(wo))) *
                        (wi.z * (F(1) + distribution.lambda(wi))));
    }
  }
};

}  // namespace kiln

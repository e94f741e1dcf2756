// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>

#include "kiln/brdf/fujii.h"

namespace kiln {

/// Energy-preserving Oren-Nayar: Fujii's form plus a multiple-scattering lobe that returns what the
/// first bounce loses. Reciprocal; a white surface reflects all light from every direction.
///
///     f = f_Fujii + rho_ms (1 - E(mu_i))(1 - E(mu_o)) / (pi (1 - E_avg))
///     rho_ms = rho^2 E_avg / (1 - rho (1 - E_avg))
///
/// with E and E_avg the albedos of a white Fujii surface.
///
/// @valid  color in [0,1], roughness r in [0,1]; r = 0 is Lambert
/// @source Portsmouth, Kutz and Hill 2025, "EON: A practical energy-preserving rough diffuse BRDF";
///         Fujii 2012
template <class F>
struct Eon {
  static constexpr std::string_view name = "eon";
  static constexpr std::string_view summary = "energy-preserving Oren-Nayar";
  static constexpr std::string_view source = "Portsmouth, Kutz and Hill 2025";
  static constexpr std::array params = {color_param, diffuse_roughness_param};
  static constexpr bool constant_albedo = false;
  static constexpr bool reciprocal = true;
  static constexpr bool has_albedo = true;
  static constexpr bool closed_albedo = true;
  static constexpr double greatest_albedo = 1;

  Vec3<F> color;  ///< rho, reflectance [0..1]
  F roughness;    ///< r [0..1]

  /// f_r [1/sr], without the cosine.
  Vec3<F> eval(const Vec3<F>& wo, const Vec3<F>& wi) const {
    const Fujii<F> first = first_bounce();
    const F single = first.shape(wo, wi);
    const F average = first.white_average();
    const F missing = max(F(1) - average, F(1e-7));
    const F lost_i = F(1) - first.white_albedo(max(wi.z, F(0)));
    const F lost_o = F(1) - first.white_albedo(max(wo.z, F(0)));
    const F multiple = lost_i * lost_o / (F(pi) * missing);
    return color * single + multiple_color(average) * multiple;
  }

  /// Reflected share of the light that comes from (or goes to) a direction with cosine mu.
  Vec3<F> albedo(F mu) const {
    const Fujii<F> first = first_bounce();
    const F single = first.white_albedo(mu);
    return color * single + multiple_color(first.white_average()) * (F(1) - single);
  }

 private:
  Fujii<F> first_bounce() const { return {color, roughness}; }

  Vec3<F> multiple_color(F average) const {
    const auto channel = [average](F rho) {
      return rho * rho * average / (F(1) - rho * (F(1) - average));
    };
    return {channel(color.x), channel(color.y), channel(color.z)};
  }
};

}  // namespace kiln

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>

#include "kiln/brdf/fujii.h"

namespace kiln {

/// Burley's diffuse with retro-reflection; gains energy for roughness above 0.40.
///
///     f = rho / pi (1 + (F90 - 1)(1 - mu_i)^5)(1 + (F90 - 1)(1 - mu_o)^5)
///     F90 = 1/2 + 2 r c^2,   c^2 = (1 + wo.wi) / 2
///
/// @valid  color in [0,1], perceptual roughness r in [0,1]
/// @source Burley 2012
template <class F>
struct Burley {
  static constexpr std::string_view name = "burley";
  static constexpr std::string_view summary = "diffuse with retro-reflection; gains energy";
  static constexpr std::string_view source = "Burley 2012";
  static constexpr std::array params = {color_param, diffuse_roughness_param};
  static constexpr bool constant_albedo = false;
  static constexpr bool reciprocal = true;
  static constexpr bool has_albedo = true;
  static constexpr bool closed_albedo = true;
  static constexpr double greatest_albedo = 1.5576;  ///< roughness 1, grazing

  Vec3<F> color;  ///< rho, reflectance [0..1]
  F roughness;    ///< r, perceptual [0..1]

  /// f_r [1/sr], without the cosine.
  Vec3<F> eval(const Vec3<F>& wo, const Vec3<F>& wi) const {
    const F rise = fma(roughness, F(1) + dot(wo, wi), F(-0.5));  // F90 - 1
    const F o = fma(rise, weight(wo.z), F(1)), i = fma(rise, weight(wi.z), F(1));
    return color * (o * i * F(1 / pi));
  }

  /// Reflected share of the light that comes from (or goes to) a direction with cosine mu: with
  /// a = (1 - mu)^5 and d = r - 1/2,
  ///
  ///     E / rho = 1 + 2 (d / 42 + r mu / 168 + a (d / 2 + r mu / 3) + a (d^2 / 42 +
  ///               2 d r mu / 168 + r^2 mu^2 / 504 + r^2 (1 - mu^2)(1/42 - 1/504) / 2))
  Vec3<F> albedo(F mu) const {
    const F a = weight(mu), d = roughness - F(0.5), m = roughness * mu;
    const F linear = fma(d, F(1.0 / 42), m * F(1.0 / 168));
    const F slope = fma(d, F(0.5), m * F(1.0 / 3));
    const F sine_part = square(roughness) * (F(1) - mu * mu) * F((1.0 / 42 - 1.0 / 504) / 2);
    const F square_part =
        fma(d * d, F(1.0 / 42), fma(d * m, F(2.0 / 168), fma(m * m, F(1.0 / 504), sine_part)));
    return color * fma(F(2), fma(a, slope + square_part, linear), F(1));
  }

 private:
  static F weight(F mu) { return pow5(clamp(F(1) - mu, F(0), F(1))); }
};

}  // namespace kiln

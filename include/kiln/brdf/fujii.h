// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>

#include "kiln/brdf/model_param.h"
#include "kiln/math/vec.h"

namespace kiln {

// A diffuse model is a colour and a roughness. `constant_albedo` says that it reflects the same
// share from every direction, `reciprocal` that directions may be swapped, `closed_albedo` that
// `albedo` is exact, else it is a fit; `greatest_albedo` what a white surface reflects at most.

inline constexpr ModelParam color_param{"color", 0, 1, 0.5, "reflectance"};
inline constexpr ModelParam diffuse_roughness_param{"roughness", 0, 1, 0.5,
                                                    "perceptual, of the texel"};

/// Fujii's smooth form of Oren-Nayar, first bounce only.
///
///     f = rho A (1 + r s / t) / pi,   s = wi.wo - mu_i mu_o,   t = max(mu_i, mu_o) if s > 0 else 1
///     A = 1 / (1 + (1/2 - 2/(3 pi)) r)
///
/// @valid  color in [0,1], roughness r in [0,1]; r = 0 is Lambert
/// @source Fujii 2012; albedo by Portsmouth, Kutz and Hill 2025
template <class F>
struct Fujii {
  static constexpr std::string_view name = "fujii";
  static constexpr std::string_view summary = "smooth form of Oren-Nayar, loses light";
  static constexpr std::string_view source = "Fujii 2012";
  static constexpr std::array params = {color_param, diffuse_roughness_param};
  static constexpr bool constant_albedo = false;
  static constexpr bool reciprocal = true;
  static constexpr bool has_albedo = true;
  static constexpr bool closed_albedo = true;
  static constexpr double greatest_albedo = 1;

  Vec3<F> color;  ///< rho, reflectance [0..1]
  F roughness;    ///< r [0..1]

  /// f_r [1/sr], without the cosine.
  Vec3<F> eval(const Vec3<F>& wo, const Vec3<F>& wi) const { return color * shape(wo, wi); }

  /// Reflected share of the light that comes from (or goes to) a direction with cosine mu.
  Vec3<F> albedo(F mu) const { return color * white_albedo(mu); }

  /// eval of a white surface [1/sr].
  F shape(const Vec3<F>& wo, const Vec3<F>& wi) const {
    const F mu_o = max(wo.z, F(0)), mu_i = max(wi.z, F(0));
    const F s = fma(wi.x, wo.x, wi.y * wo.y);
    const F t = select(s > F(0), max(max(mu_i, mu_o), F(1e-6)), F(1));
    return scale() * fma(roughness, s / t, F(1)) * F(1 / pi);
  }

  /// E = A (1 + r G(mu) / pi),
  /// G(mu) = S (acos mu - S mu) + 2/3 ((S/mu)(1 - S^3) - S) with S = sin theta. 1 - S^3 is written
  /// as mu^2 (1 + S + S^2) / (1 + S), so that nothing is divided by a small mu.
  F white_albedo(F mu) const {
    const F sine = safe_sqrt(F(1) - mu * mu);
    const F angle = atan2(sine, mu);
    const F rest = mu * fma(sine, fma(sine, sine, sine), sine) / (F(1) + sine);
    const F g = fma(sine, fma(-sine, mu, angle), F(2.0 / 3) * (rest - sine));
    return scale() * fma(roughness * F(1 / pi), g, F(1));
  }

  /// Cosine-weighted average of white_albedo, A (1 + (2/3 - 28 / (15 pi)) r).
  F white_average() const { return scale() * fma(roughness, F(2.0 / 3 - 28 / (15 * pi)), F(1)); }

 private:
  F scale() const { return F(1) / fma(roughness, F(0.5 - 2 / (3 * pi)), F(1)); }
};

}  // namespace kiln

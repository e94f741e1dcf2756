// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "kiln/math/vec.h"

namespace kiln {

/// Energy-preserving Oren-Nayar: Fujii's form plus a multiple-scattering lobe that returns what the
/// first bounce loses. Reciprocal; a white surface reflects all light from every direction.
///
///     f   = rho A (1 + r s / t) / pi + rho_ms (1 - E(mu_i))(1 - E(mu_o)) / (pi (1 - E_avg))
///     s   = wi.wo - mu_i mu_o,  t = max(mu_i, mu_o) if s > 0 else 1,  A = 1 / (1 + (1/2 - 2/(3
///     pi)) r) E   = A (1 + r G(mu) / pi),  rho_ms = rho^2 E_avg / (1 - rho (1 - E_avg))
///
/// @valid  color in [0,1], roughness r in [0,1]; r = 0 is Lambert
/// @source Portsmouth, Kutz and Hill 2025, "EON: A practical energy-preserving rough diffuse BRDF";
///         Fujii 2012
template <class F>
struct Eon {
  static constexpr std::string_view name = "eon";
  static constexpr std::string_view summary = "energy-preserving Oren-Nayar";
  static constexpr std::string_view source = "Portsmouth, Kutz and Hill 2025";
  static constexpr bool constant_albedo = false;

  Vec3<F> color;  ///< rho, reflectance [0..1]
  F roughness;    ///< r [0..1]

  /// f_r [1/sr], without the cosine.
  Vec3<F> eval(const Vec3<F>& wo, const Vec3<F>& wi) const {
    const F mu_o = max(wo.z, F(0)), mu_i = max(wi.z, F(0));
    const F s = fma(wi.x, wo.x, wi.y * wo.y);
    const F t = select(s > F(0), max(max(mu_i, mu_o), F(1e-6)), F(1));
    const F single = scale() * fma(roughness, s / t, F(1)) * F(1 / pi);
    const F average = single_average();
    const F missing = max(F(1) - average, F(1e-7));
    const F multiple =
        (F(1) - single_albedo(mu_i)) * (F(1) - single_albedo(mu_o)) / (F(pi) * missing);
    return color * single + multiple_color(average) * multiple;
  }

  /// Reflected share of the light that comes from (or goes to) a direction with cosine mu.
  Vec3<F> albedo(F mu) const {
    const F single = single_albedo(mu);
    return color * single + multiple_color(single_average()) * (F(1) - single);
  }

 private:
  F scale() const { return F(1) / fma(roughness, F(0.5 - 2 / (3 * pi)), F(1)); }

  F single_average() const { return scale() * fma(roughness, F(2.0 / 3 - 28 / (15 * pi)), F(1)); }

  // G(mu) = S (acos mu - S mu) + 2/3 ((S/mu)(1 - S^3) - S) with S = sin theta. 1 - S^3 is written
  // as mu^2 (1 + S + S^2) / (1 + S), so that nothing is divided by a small mu.
  F single_albedo(F mu) const {
    const F sine = safe_sqrt(F(1) - mu * mu);
    const F angle = atan2(sine, mu);
    const F rest = mu * fma(sine, fma(sine, sine, sine), sine) / (F(1) + sine);
    const F g = fma(sine, fma(-sine, mu, angle), F(2.0 / 3) * (rest - sine));
    return scale() * fma(roughness * F(1 / pi), g, F(1));
  }

  Vec3<F> multiple_color(F average) const {
    const auto channel = [average](F rho) {
      return rho * rho * average / (F(1) - rho * (F(1) - average));
    };
    return {channel(color.x), channel(color.y), channel(color.z)};
  }
};

}  // namespace kiln

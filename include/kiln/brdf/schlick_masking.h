// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "kiln/brdf/slopes.h"

namespace kiln {

/// Schlick's rational masking, G1 = mu / (mu (1 - k) + k), of any k in [0,1]; G2 is the product.
/// @source Schlick 1994
template <class F>
struct RationalMasking {
  F k;

  F denominator(F mu) const { return fma(mu, F(1) - k, k); }
  F G1(F mu) const { return mu / max(denominator(mu), F(1e-30)); }
  F visibility(F mu_o, F mu_i) const { return F(0.25) / (denominator(mu_o) * denominator(mu_i)); }
};

/// What the three customary choices of k share. @tparam Width  k of a width alpha
template <class F, class Width>
struct SchlickMasking {
  template <class Distribution>
  static constexpr bool fits = Distribution::alpha_is_width;
  static constexpr bool one_sided = true;

  template <class Distribution>
  static RationalMasking<F> rational(const Distribution& distribution) {
    return {Width::k(mean_width(distribution))};
  }

  template <class Distribution>
  static F G1(const Distribution& distribution, const Vec3<F>& w, const Vec3<F>&) {
    return rational(distribution).G1(max(w.z, F(0)));
  }

  template <class Distribution>
  static F G2(const Distribution& distribution, const Vec3<F>& wo, const Vec3<F>& wi,
              const Vec3<F>&) {
    const RationalMasking<F> masking = rational(distribution);
    return masking.G1(max(wo.z, F(0))) * masking.G1(max(wi.z, F(0)));
  }

  /// @valid mu_o, mu_i > 0
  template <class Distribution>
  static F visibility(const Distribution& distribution, const Vec3<F>& wo, const Vec3<F>& wi,
                      const Vec3<F>&) {
    return rational(distribution).visibility(wo.z, wi.z);
  }
};

/// Schlick's fit to Smith's masking of Beckmann: k = alpha sqrt(2 / pi).
template <class F>
struct SchlickBeckmann : SchlickMasking<F, SchlickBeckmann<F>> {
  static constexpr std::string_view name = "schlick-beckmann";
  static constexpr std::string_view summary = "Schlick's masking, k = alpha sqrt(2/pi)";
  static constexpr std::string_view source = "Schlick 1994";
  static F k(F alpha) { return alpha * F(0.79788456080286535588); }
};

/// The fit to Smith's masking of GGX for environments: k = alpha / 2. Exact for alpha = 1.
template <class F>
struct SchlickGgx : SchlickMasking<F, SchlickGgx<F>> {
  static constexpr std::string_view name = "schlick-ggx";
  static constexpr std::string_view summary = "Schlick's masking, k = alpha/2, for environments";
  static constexpr std::string_view source = "Karis 2013";
  static F k(F alpha) { return F(0.5) * alpha; }
};

/// The choice for point lights: k = (roughness + 1)^2 / 8 with roughness = sqrt(alpha). Smooth
/// surfaces are masked too, so it is not for environments.
template <class F>
struct SchlickGgxDirect : SchlickMasking<F, SchlickGgxDirect<F>> {
  static constexpr std::string_view name = "schlick-ggx-direct";
  static constexpr std::string_view summary =
      "Schlick's masking, k = (roughness + 1)^2 / 8, for point lights only";
  static constexpr std::string_view source = "Karis 2013";
  static F k(F alpha) { return F(0.125) * square(sqrt(alpha) + F(1)); }
};

}  // namespace kiln

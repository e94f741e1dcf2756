// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>

#include "kiln/brdf/fujii.h"

namespace kiln {

/// Hammon's fit to the diffuse light of a GGX microsurface, alpha = roughness^2.
///
///     f = rho (lerp(smooth, rough, alpha) / pi + 0.1159 rho alpha)
///     smooth = 1.05 (1 - (1 - mu_i)^5)(1 - (1 - mu_o)^5)
///     rough = v (0.9 - 0.4 v)(1/2 + mu_h) / mu_h,   v = (1 + wo.wi) / 2
///
/// mu_h = (mu_o + mu_i) / (2 sqrt v).
///
/// @valid  color in [0,1], perceptual roughness in [0,1]
/// @source Hammon 2017, "PBR Diffuse Lighting for GGX+Smith Microsurfaces"
template <class F>
struct HammonDiffuse {
  static constexpr std::string_view name = "hammon";
  static constexpr std::string_view summary = "diffuse of GGX microsurfaces; gains energy";
  static constexpr std::string_view source = "Hammon 2017";
  static constexpr std::array params = {color_param, diffuse_roughness_param};
  static constexpr bool constant_albedo = false;
  static constexpr bool reciprocal = true;
  static constexpr bool has_albedo = true;
  static constexpr bool closed_albedo = false;
  static constexpr double greatest_albedo = 1.1806;  ///< roughness 1, grazing

  Vec3<F> color;  ///< rho, reflectance [0..1]
  F roughness;    ///< perceptual [0..1]

  /// f_r [1/sr], without the cosine.
  Vec3<F> eval(const Vec3<F>& wo, const Vec3<F>& wi) const {
    const F mu_o = max(wo.z, F(0)), mu_i = max(wi.z, F(0));
    const F v = max(F(0.5) * (F(1) + dot(wo, wi)), F(0));
    const F inverse_mu_h = F(2) * sqrt(v) / max(mu_o + mu_i, F(1e-9));
    const F rough = v * fma(F(-0.4), v, F(0.9)) * fma(F(0.5), inverse_mu_h, F(1));
    const F smooth = F(1.05) * open(mu_o) * open(mu_i);
    const F alpha = square(roughness);
    const F single = lerp(smooth, rough, alpha) * F(1 / pi);
    return color * single + color * color * (F(0.1159) * alpha);
  }

  /// Reflected share of the light that comes from (or goes to) a direction with cosine mu. That of
  /// the smooth part is 1 - (1 - mu)^5 exactly; that of the rough part is a fit P + Q ln mu.
  /// @accuracy 1e-6 absolute
  Vec3<F> albedo(F mu) const {
    const F alpha = square(roughness);
    const F single = lerp(open(mu), rough_albedo(clamp(mu, F(0), F(1))), alpha);
    return color * single + color * color * (F(0.1159 * pi) * alpha);
  }

 private:
  static F open(F mu) { return F(1) - pow5(clamp(F(1) - mu, F(0), F(1))); }

  static F rough_albedo(F mu) {
    const F m = max(mu, F(1e-12));
    F p = fma(m, F(-0.0162135331278), F(0.153920760218));
    p = fma(m, p, F(0.305356511702));
    p = fma(m, p, F(-0.971473869658));
    p = fma(m, p, F(0.435048141377));
    p = fma(m, p, F(0.816428792476));
    const F q = m * fma(m, fma(m, F(-0.388709054833), F(0.019785961178)), F(0.492633148635));
    return fma(q, log(m), p);
  }
};

}  // namespace kiln

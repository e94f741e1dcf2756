// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>

#include "kiln/brdf/model_param.h"
#include "kiln/brdf/slopes.h"

namespace kiln {

/// The GGX (Trowbridge-Reitz) distribution of microfacet normals.
template <class F>
struct Ggx {
  static constexpr std::string_view name = "ggx";
  static constexpr std::string_view summary = "GGX (Trowbridge-Reitz) microfacet normals";
  static constexpr std::string_view source = "Trowbridge & Reitz 1975; Walter et al. 2007";

  static constexpr std::array params = {alpha_x_param, alpha_y_param};
  static constexpr bool anisotropic = true;     ///< alpha_x may differ from alpha_y
  static constexpr bool alpha_is_width = true;  ///< alpha is a width of slopes
  static constexpr bool has_lambda = true;
  static constexpr bool exact_lambda = true;

  F alpha_x, alpha_y;

  static Ggx make(F alpha_x, F alpha_y, F) { return {alpha_x, alpha_y}; }
  static Ggx isotropic(F alpha) { return {alpha, alpha}; }

  /// Density of microfacet normals.
  ///
  ///     D(m) = 1 / (pi ax ay ((mx/ax)^2 + (my/ay)^2 + mz^2)^2)      if mz > 0, else 0
  ///
  /// In float the bracket is (mx/ax)^2 + (my/ay)^2 + mz^2 as it stands: it has no cancellation.
  ///
  /// @param wm  microfacet normal, unit, shading frame
  /// @return    [1/sr], >= 0; integrates to 1 against wm.z over the hemisphere
  /// @valid     alpha_x, alpha_y in [1e-4, 1]
  /// @accuracy  float vs double <= 16 ulp for a wm of that type
  /// @source    Walter et al. 2007 (isotropic form); Burley 2012, appendix B
  F D(const Vec3<F>& wm) const {
    const F x = wm.x / alpha_x, y = wm.y / alpha_y;
    const F e = fma(x, x, fma(y, y, wm.z * wm.z));
    const F density = F(1) / (F(pi) * alpha_x * alpha_y * e * e);
    return select(wm.z > F(0), density, F(0));
  }

  /// Density of microfacet slopes, D cos^4, as a function of the squared slope stretched to unit
  /// width, q = (sx/ax)^2 + (sy/ay)^2.
  F P22(F q) const { return F(1) / (F(pi) * alpha_x * alpha_y * square(F(1) + q)); }

  /// Length of w after stretching the surface so that alpha becomes 1: |(ax wx, ay wy, wz)|.
  F stretched_length(const Vec3<F>& w) const {
    const F x = alpha_x * w.x, y = alpha_y * w.y;
    return sqrt(fma(x, x, fma(y, y, w.z * w.z)));
  }

  /// Smith's Lambda, (sqrt(1 + q) - 1) / 2 with q = (alpha tan theta)^2, without cancellation.
  /// @source Heitz 2014
  F lambda(const Vec3<F>& w) const {
    const F x = alpha_x * w.x, y = alpha_y * w.y;
    const F q = fma(x, x, y * y) / max(w.z * w.z, F(1e-30));
    return q / (F(2) * (F(1) + sqrt(F(1) + q)));
  }

  /// A microfacet normal with density D(wm) wm.z: t^2 = u / (1 - u) in stretched slopes.
  /// @param u  uniform in (0,1)^2
  /// @source   Walter et al. 2007
  Vec3<F> sample(const Vec2<F>& u) const {
    const F t = sqrt(u.y / (F(1) - u.y)), phi = F(2 * pi) * u.x;
    return normal_of_slopes(alpha_x * t * cos(phi), alpha_y * t * sin(phi));
  }

  /// A microfacet normal visible from wo, drawn from the bounded spherical cap, for which few
  /// reflections fall below the horizon.
  /// @param u  uniform in (0,1)^2
  /// @valid    wo.z > 0
  /// @source   Dupuy and Benyoub 2023; Eto and Tokuyoshi 2023 (bound)
  Vec3<F> sample_visible(const Vec3<F>& wo, const Vec2<F>& u) const {
    const Vec3<F> stretched = normalize(Vec3<F>{alpha_x * wo.x, alpha_y * wo.y, wo.z});
    const F phi = F(2 * pi) * u.x;
    const F b = bound(wo) * stretched.z;
    const F z = fma(F(1) - u.y, F(1) + b, -b);
    const F r = safe_sqrt(F(1) - z * z);
    const Vec3<F> cap{r * cos(phi), r * sin(phi), z};
    const Vec3<F> h = cap + stretched;
    return normalize(Vec3<F>{alpha_x * h.x, alpha_y * h.y, max(h.z, F(1e-12))});
  }

  /// Density of the reflection of wo about sample_visible(wo, u).
  ///
  ///     p(wi) = D(wm) / (2 (k wo.z + |stretched wo|))
  ///
  /// @return [1/sr]; integrates over wi.z > 0 to 1 minus the share rejected below the horizon
  F visible_density(const Vec3<F>& wo, F d_of_wm) const {
    return d_of_wm / (F(2) * (bound(wo) * wo.z + stretched_length(wo)));
  }

 private:
  // k of the bounded cap; 1 would be the unbounded one.
  F bound(const Vec3<F>& wo) const {
    const F a = min(min(alpha_x, alpha_y), F(1));
    const F s = F(1) + safe_sqrt(fma(wo.x, wo.x, wo.y * wo.y));
    const F a2 = a * a, s2 = s * s;
    return (F(1) - a2) * s2 / (s2 + a2 * wo.z * wo.z);
  }
};

}  // namespace kiln

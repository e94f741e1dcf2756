// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "kiln/brdf/energy.h"
#include "kiln/brdf/ggx.h"
#include "kiln/brdf/smith.h"

namespace kiln {

enum class Energy {
  Multiscatter,  ///< light that bounces between microfacets is returned
  Single         ///< first bounce only: rough metals darken
};

/// What a surface sends toward wo per unit of radiance from wi [1/sr], without the cosine.
template <class F>
struct Reflected {
  Vec3<F> specular, diffuse;
};

/// A BRDF put together: GGX with height-correlated Smith masking and Schlick's Fresnel over a
/// diffuse lobe, coupled so that nothing reflects more than it receives. The common path; lanes
/// hold texels.
template <class F, class Diffuse>
struct Surface {
  Ggx<F> ggx;
  PerChannel<Schlick<F>> fresnel;
  Diffuse diffuse;
  Vec3<F> multiple;             ///< F_ms per channel, 0 without multiple scattering
  SpecularChannel<F> greatest;  ///< the channel with the greatest F0

  /// @param average  the lobe's split-sum terms averaged over directions
  static Surface make(F alpha, const PerChannel<Schlick<F>>& fresnel, const Diffuse& diffuse,
                      const SplitSumTerms<F>& average, Energy energy) {
    Surface surface{Ggx<F>::isotropic(alpha), fresnel, diffuse, {F(0), F(0), F(0)}, {}};
    if (energy == Energy::Multiscatter) {
      const Vec3<F> f = fresnel.average();
      const F e = average.total();
      surface.multiple = {multiple_scattering_color(f.x, e), multiple_scattering_color(f.y, e),
                          multiple_scattering_color(f.z, e)};
    }
    const F f0 = max(fresnel.x.f0, max(fresnel.y.f0, fresnel.z.f0));
    surface.greatest = {f0, fresnel.x.f90, max_component(surface.multiple)};
    return surface;
  }

  /// Reflectance of the specular lobe toward a direction, per channel.
  Vec3<F> specular_reflectance(const SplitSumTerms<F>& terms) const {
    const auto channel = [&](const Schlick<F>& schlick, F m) {
      return SpecularChannel<F>{schlick.f0, schlick.f90, m}.reflectance(terms);
    };
    return {channel(fresnel.x, multiple.x), channel(fresnel.y, multiple.y),
            channel(fresnel.z, multiple.z)};
  }

  /// @param wm  the half vector of wo and wi
  /// @param d   ggx.D(wm)
  /// @valid     wo.z > 0 and wi.z > 0
  Reflected<F> eval(const Vec3<F>& wo, const Vec3<F>& wi, const Vec3<F>& wm, F d,
                    const Albedo<F>& albedo) const {
    const F lobe = d * SmithCorrelated<F>::visibility(ggx, wo, wi, wm);
    const Vec3<F> single = fresnel.eval(dot(wo, wm)) * lobe;
    const F weight = coupling(greatest, albedo, Diffuse::constant_albedo);
    return {single + multiple * multiple_scattering(albedo), diffuse.eval(wo, wi) * weight};
  }
};

template <class F>
Vec3<F> half_vector(const Vec3<F>& wo, const Vec3<F>& wi) {
  const Vec3<F> sum = wo + wi;
  return sum * (F(1) / max(length(sum), F(1e-12)));
}

/// A direction about +z with density cos(theta) / pi.
/// @param u  uniform in (0,1)^2
template <class F>
Vec3<F> square_to_cosine(const Vec2<F>& u) {
  const F phi = F(2 * pi) * u.x;
  const F r = sqrt(u.y);
  return {r * cos(phi), r * sin(phi), safe_sqrt(F(1) - u.y)};
}

/// Density of square_to_cosine [1/sr].
template <class F>
F cosine_density(const Vec3<F>& w) {
  return max(w.z, F(0)) * F(1 / pi);
}

}  // namespace kiln

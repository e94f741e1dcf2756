// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "kiln/brdf/dielectric.h"
#include "kiln/brdf/ggx.h"
#include "kiln/brdf/smith.h"

namespace kiln {

/// What a path carries through the surface: radiance, traced from the viewer, shrinks and grows
/// with the solid angle at a refraction; importance (or light, traced from its source) does not.
enum class Transport { Radiance, Importance };

/// A direction drawn from a rough dielectric, and what it is worth.
template <class F>
struct DielectricSample {
  Vec3<F> wi;
  F weight;   ///< f |cos| / density; 0 where the draw is rejected, and wi then means nothing
  F density;  ///< [1/sr]
  MaskOf<F> transmitted;
};

/// The rough boundary of two dielectrics: a BSDF that reflects and transmits.
///
///     f_r = F D G2 / (4 |n.o| |n.i|)                                    wi on the side of wo
///     f_t = (1 - F) D G2 |m.o| |m.i| s^2 / (|n.o| |n.i| |o + s i|^2)    wi on the other side
///
/// with s the refractive index of wi's side relative to wo's and m along o + s i. This f_t is that
/// of importance; of radiance it is f_t / s^2, so that f_t(i, o) / eta_o^2 = f_t(o, i) / eta_i^2.
/// Both sides see the same GGX surface; of opposite sides G2 is the masking function's of wo and wi
/// mirrored to wo's side, the form that renderers ship (for SmithCorrelated
/// 1 / (1 + Lambda(o) + Lambda(i)); the microsurface itself asks for Beta(1 + Lambda(o),
/// 1 + Lambda(i)), which is not far from the separable product).
///
/// At eta = 1 exactly light passes straight on: there is no density to speak of, so f_t and the
/// density of transmission are 0 and sample() alone gives the answer.
///
/// @valid     alpha_x, alpha_y in [1e-4, 1]; eta in (0, inf); every direction, 0 along the surface
/// @accuracy  the normal of a refraction is known to ulp / |eta - 1|
/// @source    Walter et al. 2007; radiance scaling: Veach 1997; Heitz et al. 2016 (exact G2)
template <class F, template <class> class Masking = SmithCorrelated>
struct RoughDielectric {
  F alpha_x, alpha_y;
  F eta;  ///< refractive index below the surface over that above

  /// @return [1/sr], without the cosine, >= 0
  F eval(const Vec3<F>& wo, const Vec3<F>& wi, Transport transport = Transport::Radiance) const {
    const Geometry at = meet(wo, wi);
    const F g2_over_cosines = F(4) * Masking<F>::visibility(ggx(), at.wo, at.wi_mirrored, at.wm);
    const F common = ggx().D(at.wm) * g2_over_cosines;
    const F reflected = F(0.25) * common * at.reflectance;
    F transmitted = (F(1) - at.reflectance) * common * at.refraction_jacobian * at.cosine_o;
    if (transport == Transport::Radiance) transmitted = transmitted / (at.step * at.step);
    return select(at.possible, select(at.below, transmitted, reflected), F(0));
  }

  /// Density of sample(wo, u).wi.
  /// @return [1/sr]; integrates over all directions to 1 minus the share of rejected draws
  F density(const Vec3<F>& wo, const Vec3<F>& wi) const {
    const Geometry at = meet(wo, wi);
    return select(at.possible, density_at(at), F(0));
  }

  /// Draws a normal that wo sees, then reflects with probability F and refracts otherwise.
  ///
  /// Draws whose direction ends on the wrong side of the surface are rejected.
  /// @param u  uniform in (0,1)^3
  DielectricSample<F> sample(const Vec3<F>& wo, const Vec3<F>& u,
                             Transport transport = Transport::Radiance) const {
    const F side = select(wo.z < F(0), F(-1), F(1));
    Geometry at;
    at.wo = wo * side;
    at.step = select(wo.z < F(0), F(1) / eta, eta);
    at.wm = visible_normal(at.wo, {u.x, u.y});
    at.cosine_o = min(max(dot(at.wo, at.wm), F(0)), F(1));
    at.reflectance = Dielectric<F>{at.step}.eval(at.cosine_o);
    at.below = u.z >= at.reflectance;
    const Vec3<F> wi = select(at.below, refract(at), at.wm * (F(2) * at.cosine_o) - at.wo);
    at.wi_mirrored = {wi.x, wi.y, abs(wi.z)};
    const Vec3<F> chord = at.wo + wi * at.step;
    at.set_jacobian(dot(wi, at.wm), dot(chord, chord));
    const auto kept = ((wi.z < F(0)) == at.below) && (wi.z != F(0)) && (at.wo.z > F(0));
    const F stretched = at.wo.z + ggx().stretched_length(at.wo);
    const F g2_over_g1 = F(2) * at.wi_mirrored.z * stretched *
                         Masking<F>::visibility(ggx(), at.wo, at.wi_mirrored, at.wm);
    const F shrink = transport == Transport::Radiance ? F(1) / (at.step * at.step) : F(1);
    return {wi * side, select(kept, select(at.below, g2_over_g1 * shrink, g2_over_g1), F(0)),
            select(kept, density_at(at), F(0)), at.below};
  }

 private:
  // Two directions and the normal that takes one to the other, turned so that wo is above.
  struct Geometry {
    Vec3<F> wo, wi_mirrored, wm;  // wi_mirrored: on wo's side
    F step;                       // refractive index of the side below over that above
    F cosine_o, reflectance;
    F refraction_jacobian;  // dwm / dwi of refraction
    MaskOf<F> below, possible;

    void set_jacobian(F cosine_i, F chord2) {
      refraction_jacobian =
          select(chord2 > F(1e-30), step * step * abs(cosine_i) / max(chord2, F(1e-30)), F(0));
    }
  };

  Ggx<F> ggx() const { return {alpha_x, alpha_y}; }

  Geometry meet(const Vec3<F>& wo, const Vec3<F>& wi) const {
    const F side = select(wo.z < F(0), F(-1), F(1));
    const Vec3<F> i = wi * side;
    Geometry at;
    at.wo = wo * side;
    at.wi_mirrored = {i.x, i.y, abs(i.z)};
    at.step = select(wo.z < F(0), F(1) / eta, eta);
    at.below = i.z < F(0);
    const Vec3<F> chord = at.wo + i * select(at.below, at.step, F(1));
    const F chord2 = dot(chord, chord);
    const F scale = F(1) / sqrt(max(chord2, F(1e-30)));
    at.wm = chord * select(chord.z < F(0), -scale, scale);
    at.cosine_o = dot(at.wo, at.wm);
    const F cosine_i = dot(i, at.wm);
    at.reflectance = Dielectric<F>{at.step}.eval(at.cosine_o);
    at.set_jacobian(cosine_i, chord2);
    at.possible = (at.wo.z > F(0)) && (at.wi_mirrored.z > F(0)) && (at.cosine_o > F(0)) &&
                  ((cosine_i < F(0)) == at.below);
    return at;
  }

  // Visible normals, D (o.m) G1 / n.o with G1 / n.o = 2 / (n.o + |stretched o|), times the choice
  // of reflection or refraction and its Jacobian.
  F density_at(const Geometry& at) const {
    const F normals = F(2) * ggx().D(at.wm) / (at.wo.z + ggx().stretched_length(at.wo));
    return normals * select(at.below,
                            (F(1) - at.reflectance) * at.cosine_o * at.refraction_jacobian,
                            F(0.25) * at.reflectance);
  }

  static Vec3<F> refract(const Geometry& at) {
    const F sine2 = fma(-at.cosine_o, at.cosine_o, F(1));
    const F cosine_t = safe_sqrt(F(1) - sine2 / (at.step * at.step));
    return at.wm * (at.cosine_o / at.step - cosine_t) - at.wo * (F(1) / at.step);
  }

  // A whole spherical cap: normals whose reflection is lost below the horizon still refract.
  // Dupuy and Benyoub 2023.
  Vec3<F> visible_normal(const Vec3<F>& wo, const Vec2<F>& u) const {
    const Vec3<F> stretched = normalize(Vec3<F>{alpha_x * wo.x, alpha_y * wo.y, wo.z});
    const F phi = F(2 * pi) * u.x;
    const F z = fma(F(1) - u.y, F(1) + stretched.z, -stretched.z);
    const F r = safe_sqrt(F(1) - z * z);
    const Vec3<F> h = Vec3<F>{r * cos(phi), r * sin(phi), z} + stretched;
    return normalize(Vec3<F>{alpha_x * h.x, alpha_y * h.y, max(h.z, F(1e-12))});
  }
};

}  // namespace kiln

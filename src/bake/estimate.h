// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "kiln/light/environment.h"
#include "light_control.h"
#include "preview_pixels.h"
#include "shading_point.h"

namespace kiln {

// Radiance toward the viewer by multiple importance sampling.
//
//     L = INT f(wi) L(wi) cos(wi) dwi
//
// Each point of the set gives one direction from the environment's density p_e and one from the
// texel's own density p_b. With the balance heuristic both add f L cos / (p_e + p_b), and the sum
// over both kinds, divided by the number of points, is unbiased. Light counts from the whole
// hemisphere above the shading normal, also where that reaches below the plane of the texel: a
// tilted texel then receives as much as a flat one. Ambient occlusion dims the diffuse lobe only.

// Directional lights are summed, not sampled: f E cos for each. Their light counts from above the
// shading normal too, and is not dimmed by ambient occlusion, which is about light from all around.

/// f E cos of a light in the direction `toward`; nothing where that lies below the horizon of the
/// shading normal.
/// @param toward      unit, in the environment's space
/// @param irradiance  on a plane that faces the light
template <class F, class Diffuse>
Vec3<F> reflect_distant(const ShadingPoint<F, Diffuse>& point, const AlbedoTable& table,
                        const Vec3<F>& toward, const Vec3<F>& irradiance) {
  Vec3<F> wi = point.frame.to_local(toward);
  const auto above = wi.z > F(0);
  wi.z = max(wi.z, F(1e-6));
  const Vec3<F> wm = half_vector(point.wo, wi);
  const Albedo<F> albedo{point.terms_o, table.terms(point.row, wi.z), point.average};
  const Reflected<F> f = point.surface.eval(point.wo, wi, wm, point.surface.ggx.D(wm), albedo);
  return (f.specular + f.diffuse) * irradiance * select(above, wi.z, F(0));
}

/// (f cos - g) L / (p_e + p_b) for the direction wi in the shading frame. Below the horizon f is 0
/// and only the environment's directions count, p_b = 0.
template <class F, class Diffuse>
Vec3<F> weigh_light(const ShadingPoint<F, Diffuse>& point, const LightControl<F>& control,
                    const AlbedoTable& table, Vec3<F> wi, const Vec3<F>& radiance,
                    F light_density) {
  const Vec3<F> known = control.toward(wi);
  const auto above = wi.z > F(1e-6);
  const F cosine = select(above, wi.z, F(0));
  wi.z = max(wi.z, F(1e-6));
  const Vec3<F> wm = half_vector(point.wo, wi);
  const F d = point.surface.ggx.D(wm);
  const F own_density = lerp(cosine_density(wi), point.surface.ggx.visible_density(point.wo, d),
                             point.specular_share);
  const Albedo<F> albedo{point.terms_o, table.terms(point.row, wi.z), point.average};
  const Reflected<F> f = point.surface.eval(point.wo, wi, wm, d, albedo);
  const F weight = F(1) / (select(above, own_density, F(0)) + light_density);
  return ((f.specular + f.diffuse * point.occlusion) * cosine - known) * radiance * weight;
}

/// A direction drawn from the texel's own density; it may lie below the horizon.
template <class F, class Diffuse>
Vec3<F> sample_direction(const ShadingPoint<F, Diffuse>& point, const Vec2<F>& u) {
  const F share = point.specular_share;
  const auto specular = u.x < share;
  const F x = select(specular, u.x / share, (u.x - share) / (F(1) - share));
  const Vec2<F> v{min(x, F(1 - 0x1p-24)), u.y};
  const Vec3<F> wm = point.surface.ggx.sample_visible(point.wo, v);
  const Vec3<F> mirrored = wm * (F(2) * dot(point.wo, wm)) - point.wo;
  return select(specular, mirrored, square_to_cosine(v));
}

/// Sum over the points [first, last) of the set; divide by their number for the radiance.
template <class F, class Diffuse>
Vec3<F> sum_points(const ShadingPoint<F, Diffuse>& point, const LightControl<F>& control,
                   const Environment& environment, const AlbedoTable& table,
                   const SobolPoints& points, int first, int last,
                   const std::array<UintOf<F>, 4>& seeds) {
  Vec3<F> sum{F(0), F(0), F(0)};
  for (int i = first; i < last; ++i) {
    const std::array<F, 4> u = scrambled<F>(points[i], seeds);
    const LightSample<F> light = environment.sample(Vec2<F>{u[0], u[1]});
    sum += weigh_light(point, control, table, point.frame.to_local(light.direction), light.radiance,
                       light.density);
    const Vec3<F> wi = sample_direction(point, Vec2<F>{u[2], u[3]});
    const Arriving<F> own = environment.arriving(point.frame.to_world(wi));
    const Vec3<F> radiance = select(wi.z > F(1e-6), own.radiance, Vec3<F>{F(0), F(0), F(0)});
    sum += weigh_light(point, control, table, wi, radiance, own.density);
  }
  return sum + control.light() * F(static_cast<float>(last - first));
}

}  // namespace kiln

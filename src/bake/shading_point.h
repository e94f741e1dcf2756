// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

#include "kiln/brdf/roughness.h"
#include "kiln/brdf/surface.h"
#include "kiln/material/anisotropy.h"
#include "kiln/math/frame.h"
#include "kiln/table/albedo_table.h"
#include "texel_block.h"

namespace kiln {

/// Where a texel is: the surface's frame and the way to the viewer, in the environment's space.
template <class F>
struct Placement {
  Frame<F> frame;
  Vec3<F> to_viewer;
};

/// The least cosine between a shading normal and the viewer. Normals that turn away farther are
/// bent toward the viewer until they reach it, so that no texel is black for want of a view.
inline constexpr double least_view_cosine = 0.02;

/// Everything about a texel that does not depend on the light.
template <class F, class Diffuse>
struct ShadingPoint {
  Surface<F, Diffuse> surface;
  Frame<F> frame;  ///< shading frame, +z the bent normal
  Vec3<F> wo;      ///< to the viewer, shading frame
  F roughness;
  F occlusion;
  AlbedoRow<F> row;
  SplitSumTerms<F> terms_o, average;
  F specular_share;  ///< probability to sample the specular lobe
};

template <class F>
Vec3<F> bend_toward(const Vec3<F>& normal, const Vec3<F>& viewer) {
  const F missing = max(F(least_view_cosine) - dot(normal, viewer), F(0));
  return normalize(normal + viewer * missing);
}

/// The frame around the shading normal and the widths of the lobe along its axes.
template <class F>
struct LobeFrame {
  Frame<F> frame;
  F alpha_x, alpha_y;
  /// Of the isotropic lobe whose albedo stands in for this one's, alpha^2 = (ax^2 + ay^2) / 2: then
  /// the mean over azimuths errs by at most 0.03, one direction by up to 0.06 for alpha_x below
  /// 2.2 alpha_y and 0.17 for the strongest anisotropy.
  F table_roughness;
};

/// Widths as anisotropic_widths() has them, alpha_x along the wider axis, which is that of the maps
/// laid into the plane of the normal.
/// @param alpha  of the mean width, alpha^2 = alpha_x alpha_y
template <class F>
LobeFrame<F> anisotropic_frame(const Frame<F>& surface, const Vec3<F>& normal,
                               const Vec2<F>& anisotropy, F alpha) {
  const F squared = fma(anisotropy.x, anisotropy.x, anisotropy.y * anisotropy.y);
  const F strength = min(sqrt(squared), F(most_anisotropic));
  const F aspect = sqrt(fma(F(-0.9), strength, F(1)));
  const F double_cosine = anisotropy.x / max(sqrt(squared), F(1e-12));
  const F cosine = safe_sqrt(F(0.5) + F(0.5) * double_cosine);
  const F sine = copysign(safe_sqrt(F(0.5) - F(0.5) * double_cosine), anisotropy.y);
  const Vec3<F> wider = surface.x * cosine + surface.y * sine;
  const Vec3<F> laid = wider - normal * dot(normal, wider);
  const F reach = dot(laid, laid);
  const Frame<F> around = frame_around(normal);
  const auto usable = (squared > F(0)) && (reach > F(1e-8));
  const Vec3<F> x = select(usable, laid * (F(1) / sqrt(max(reach, F(1e-8)))), around.x);
  const Vec3<F> y = select(usable, cross(normal, x), around.y);
  const F alpha_x = clamp(alpha / aspect, F(min_alpha), F(1));
  const F alpha_y = clamp(alpha * aspect, F(min_alpha), F(1));
  const F mean_squared = F(0.5) * fma(alpha_x, alpha_x, alpha_y * alpha_y);
  return {{x, y, normal}, alpha_x, alpha_y, sqrt(sqrt(mean_squared))};
}

template <class F>
LobeFrame<F> lobe_frame(const Frame<F>& surface, const Vec3<F>& normal, const TexelValues<F>& texel,
                        F roughness) {
  const F alpha = to_alpha(roughness);
  if (any((texel.anisotropy.x != F(0)) || (texel.anisotropy.y != F(0)))) {
    return anisotropic_frame(surface, normal, texel.anisotropy, alpha);
  }
  return {frame_around(normal), alpha, alpha, roughness};
}

/// Where an engine looks up the prefiltered environment: the viewer's mirror image about the
/// normal; of an anisotropic lobe about a normal bent toward the viewer across the narrow axis.
///
///     n' = n + k (wo - y (wo.y) - n),   k = (ax - ay) / (ax + ay) min(5 r, 1)
///
/// @return in the shading frame
/// @source McAuley 2015, "Rendering the World of Far Cry 4"; Filament
template <class F>
Vec3<F> engine_direction(const Vec3<F>& wo, F alpha_x, F alpha_y, F roughness) {
  const F k = (alpha_x - alpha_y) / (alpha_x + alpha_y) * min(F(5) * roughness, F(1));
  if (!any(k > F(0))) return {-wo.x, -wo.y, wo.z};
  const Vec3<F> bent = normalize(Vec3<F>{k * wo.x, F(0), fma(k, wo.z - F(1), F(1))});
  return bent * (F(2) * dot(wo, bent)) - wo;
}

/// Reflectance of the lobe's first bounce toward the viewer.
template <class F, class Diffuse>
Vec3<F> single_reflectance(const ShadingPoint<F, Diffuse>& point) {
  const auto& fresnel = point.surface.fresnel;
  const auto channel = [&](const Schlick<F>& schlick) {
    return fma(schlick.f0, point.terms_o.scale, schlick.f90 * point.terms_o.bias);
  };
  return {channel(fresnel.x), channel(fresnel.y), channel(fresnel.z)};
}

template <class F, class Diffuse>
ShadingPoint<F, Diffuse> make_shading_point(const TexelValues<F>& texel,
                                            const Placement<F>& placement, const AlbedoTable& table,
                                            Energy energy) {
  ShadingPoint<F, Diffuse> point;
  point.roughness = clamp(texel.roughness, F(0), F(1));
  point.occlusion = texel.occlusion;
  const Vec3<F> normal = bend_toward(placement.frame.to_world(texel.normal), placement.to_viewer);
  const LobeFrame<F> lobe = lobe_frame(placement.frame, normal, texel, point.roughness);
  point.frame = lobe.frame;
  point.wo = point.frame.to_local(placement.to_viewer);
  point.wo.z = max(point.wo.z, F(1e-3));
  point.row = table.row(lobe.table_roughness);
  point.average = table.average(point.row);
  point.terms_o = table.terms(point.row, point.wo.z);
  const PerChannel<Schlick<F>> fresnel = schlick_of(texel.f0, F(1));
  const Diffuse diffuse{texel.diffuse_color, point.roughness};
  point.surface = Surface<F, Diffuse>::make(lobe.alpha_x, fresnel, diffuse, point.average, energy);
  point.surface.ggx = {lobe.alpha_x, lobe.alpha_y};
  const Vec3<F> single = single_reflectance(point);
  const Vec3<F> specular = point.surface.specular_reflectance(point.terms_o);
  const F left = max(F(1) - max_component(specular), F(0));
  const F spread = luminance(specular - single) + luminance(texel.diffuse_color) * left;
  const F share = luminance(single);
  point.specular_share = clamp(share / max(share + spread, F(1e-6)), F(0.1), F(0.9));
  return point;
}

}  // namespace kiln

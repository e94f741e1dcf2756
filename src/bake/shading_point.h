// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

#include "kiln/brdf/roughness.h"
#include "kiln/brdf/surface.h"
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

template <class F, class Diffuse>
ShadingPoint<F, Diffuse> make_shading_point(const TexelValues<F>& texel,
                                            const Placement<F>& placement, const AlbedoTable& table,
                                            Energy energy) {
  ShadingPoint<F, Diffuse> point;
  point.roughness = clamp(texel.roughness, F(0), F(1));
  point.occlusion = texel.occlusion;
  const Vec3<F> normal = bend_toward(placement.frame.to_world(texel.normal), placement.to_viewer);
  point.frame = frame_around(normal);
  point.wo = point.frame.to_local(placement.to_viewer);
  point.wo.z = max(point.wo.z, F(1e-3));
  point.row = table.row(point.roughness);
  point.average = table.average(point.row);
  point.terms_o = table.terms(point.row, point.wo.z);
  const PerChannel<Schlick<F>> fresnel = schlick_of(texel.f0, F(1));
  const Diffuse diffuse{texel.diffuse_color, point.roughness};
  point.surface =
      Surface<F, Diffuse>::make(to_alpha(point.roughness), fresnel, diffuse, point.average, energy);
  const Vec3<F> single =
      texel.f0 * point.terms_o.scale + Vec3<F>{F(1), F(1), F(1)} * point.terms_o.bias;
  const Vec3<F> specular = point.surface.specular_reflectance(point.terms_o);
  const F left = max(F(1) - max_component(specular), F(0));
  const F spread = luminance(specular - single) + luminance(texel.diffuse_color) * left;
  const F lobe = luminance(single);
  point.specular_share = clamp(lobe / max(lobe + spread, F(1e-6)), F(0.1), F(0.9));
  return point;
}

}  // namespace kiln

// SPDX-License-Identifier: Apache-2.0
#include "kiln/brdf/surface.h"
#include "preview_stages.h"

namespace kiln {
namespace {

using F = WideFloat;

template <template <class> class Distribution>
Distribution<F> distribution_of(const StagedPoint& point) {
  return Distribution<F>::make(point.alpha_x, point.alpha_y, F(point.shape));
}

template <template <class> class Distribution>
WideVec sample_normal(const StagedPoint& point, const Vec2<F>& u) {
  const auto distribution = distribution_of<Distribution>(point);
  if constexpr (requires { distribution.sample_visible(point.wo, u); }) {
    return distribution.sample_visible(point.wo, u);
  } else {
    return distribution.sample(u);
  }
}

// Of the reflection of wo about sample_normal; of normals drawn with density D wm.z that is
// D wm.z / (4 wo.wm).
template <class Distribution>
F lobe_density(const Distribution& distribution, const WideVec& wo, const WideVec& wm, F d) {
  if constexpr (requires { distribution.visible_density(wo, d); }) {
    return distribution.visible_density(wo, d);
  } else {
    return d * wm.z / (F(4.0f) * max(dot(wo, wm), F(1e-12f)));
  }
}

template <template <class> class Distribution, template <class> class Masking>
void add_lobe(const StagedPoint& point, DirectionBlock& block) {
  const auto distribution = distribution_of<Distribution>(point);
  const WideVec& wo = point.wo;
  for (int i = 0; i < block.count; ++i) {
    const WideVec wi = block.wi[i];
    const WideVec wm = half_vector(wo, wi);
    const F d = distribution.D(wm);
    block.cosine[i] = dot(wo, wm);
    block.lobe[i] = d * Masking<F>::visibility(distribution, wo, wi, wm);
    block.own_density[i] =
        lerp(cosine_density(wi), lobe_density(distribution, wo, wm, d), point.specular_share);
  }
}

template <template <class> class Distribution>
float shape_or_default(double shape) {
  if constexpr (requires { Distribution<F>::default_shape; }) {
    return static_cast<float>(shape == 0 ? Distribution<F>::default_shape : shape);
  } else {
    return 0;
  }
}

}  // namespace

void choose_lobe(const SurfaceChoice& surface, SurfaceStages& stages) {
  with_lobe(surface.distribution, surface.masking,
            [&]<template <class> class Distribution, template <class> class Masking>() {
              stages.sample_normal = sample_normal<Distribution>;
              stages.add_lobe = add_lobe<Distribution, Masking>;
              stages.shape = shape_or_default<Distribution>(surface.distribution_shape);
              stages.anisotropic = Distribution<F>::anisotropic;
              stages.alpha_is_width = Distribution<F>::alpha_is_width;
            });
}

}  // namespace kiln

// SPDX-License-Identifier: Apache-2.0
#include "lobe_kernels.h"

#include <fmt/format.h>

#include "kiln/brdf/roughness.h"
#include "kiln/core/error.h"
#include "kiln/core/names.h"

namespace kiln {
namespace {

// The sums of Schlick's terms apart: 1 - Fc, Fc and c (1 - c)^6.
void add_terms(const PointBlock& block, const FresnelChannel<double>&, Wide* sums) {
  for (int i = 0; i < block.count; ++i) {
    const Wide c = block.cosine[i];
    const Wide fc = grazing_weight(c);
    const Wide weight = block.weight[i];
    sums[0] = fma(weight, Wide(1.0) - fc, sums[0]);
    sums[1] = fma(weight, fc, sums[1]);
    sums[2] = fma(weight * fc, c * (Wide(1.0) - c), sums[2]);
  }
}

FresnelChannel<Wide> widened(const FresnelChannel<double>& channel) {
  return {Wide(channel.f0),  Wide(channel.f90),        Wide(channel.f82), Wide(channel.edge_tint),
          Wide(channel.ior), Wide(channel.extinction), Wide(channel.dip), Wide(channel.exponent)};
}

template <template <class> class Fresnel>
void add_reflectance(const PointBlock& block, const FresnelChannel<double>& channel, Wide* sums) {
  const auto fresnel = Fresnel<Wide>::make(widened(channel));
  for (int i = 0; i < block.count; ++i) {
    sums[0] = fma(block.weight[i], fresnel.eval(block.cosine[i]), sums[0]);
  }
}

// How far a dielectric's reflectance lies from F0 toward 1, never below 0: a dense one dips under
// its F0 before it rises.
void add_dielectric_share(const PointBlock& block, const FresnelChannel<double>& channel,
                          Wide* sums) {
  const auto fresnel = Dielectric<Wide>::make(widened(channel));
  const Wide f0 = fresnel.eval(Wide(1.0));
  const Wide scale = Wide(1.0) / (Wide(1.0) - f0);
  for (int i = 0; i < block.count; ++i) {
    const Wide share = max(fresnel.eval(block.cosine[i]) - f0, Wide(0.0)) * scale;
    sums[0] = fma(block.weight[i], share, sums[0]);
  }
}

// (1 - c)^p, the weight of F90 in Schlick's form with an exponent of one's own.
void add_schlick_share(const PointBlock& block, const FresnelChannel<double>& channel, Wide* sums) {
  const Wide exponent = Wide(channel.exponent);
  for (int i = 0; i < block.count; ++i) {
    const Wide rest = clamp(Wide(1.0) - block.cosine[i], Wide(1e-300), Wide(1.0));
    sums[0] = fma(block.weight[i], exp(exponent * log(rest)), sums[0]);
  }
}

// One point, the mirror direction: what is left of a lobe as its width goes to 0.
template <template <class> class Distribution, template <class> class Masking>
void reflect_mirror(const ViewRule& view, double shape, const FresnelStage& stage, Wide* sums) {
  const Wide width = Wide(1e-4 * min_alpha);
  const auto distribution = Distribution<Wide>::make(width, width, Wide(shape));
  const Vec3<Wide> wo{Wide(view.sine), Wide(0.0), Wide(view.mu)}, wi{-wo.x, wo.y, wo.z};
  const Vec3<Wide> wm{Wide(0.0), Wide(0.0), Wide(1.0)};
  PointBlock block;
  block.count = 1;
  block.weight[0] = Masking<Wide>::G2(distribution, wo, wi, wm) * Wide(1.0 / wide_lanes);
  block.cosine[0] = Wide(view.mu);
  stage.add(block, stage.fresnel, sums);
}

// No model of masking: with it a lobe is the density of visible normals, and integrals over it are
// means over what a sampler of those draws, less what it sends below the horizon.
template <class F>
struct VisibleNormals {
  template <class Distribution>
  static F G2(const Distribution& distribution, const Vec3<F>& wo, const Vec3<F>&,
              const Vec3<F>& wm) {
    return SmithCorrelated<F>::G1(distribution, wo, wm);
  }
};

template <class Masking>
constexpr double kinked_below() {
  if constexpr (requires { Masking::kinked_below; }) return Masking::kinked_below;
  return 0;
}

template <template <class> class Distribution, template <class> class Masking>
LobeKernels kernels_of() {
  const bool sheen = Distribution<Wide>::name == Charlie<Wide>::name;
  return {integrate_lobe<Distribution, Masking>,
          sheen ? nullptr : reflect_mirror<Distribution, Masking>, kinked_below<Masking<Wide>>()};
}

}  // namespace

LobeKernels find_lobe_kernels(const std::string& distribution, const std::string& masking) {
  LobeKernels found;
  if (masking == visible_normals) {
    with_lobe(distribution, "smith-correlated",
              [&]<template <class> class Distribution, template <class> class Masking>() {
                if constexpr (fits_together<Distribution, SmithCorrelated>) {
                  found = kernels_of<Distribution, VisibleNormals>();
                }
              });
    return found;
  }
  with_lobe(kebab(distribution), kebab(masking),
            [&]<template <class> class Distribution, template <class> class Masking>() {
              found = kernels_of<Distribution, Masking>();
            });
  return found;
}

double shape_of(const std::string& distribution, double shape) {
  for (const ModelFacts& model : all_models()) {
    if (model.family != "distribution" || model.name != kebab(distribution)) continue;
    for (const ModelParam& param : model.params) {
      if (param.name != "shape") continue;
      const double wanted = shape == 0 ? param.initial : shape;
      if (wanted >= param.min && wanted <= param.max) return wanted;
      throw Error(Fault::Usage, fmt::format("shape: found {}, {} takes {} to {}", shape, model.name,
                                            param.min, param.max));
    }
    if (shape == 0) return 0;
    throw Error(Fault::Usage, fmt::format("shape: {} has none", model.name));
  }
  throw Error(Fault::Usage,
              unknown_name("distribution", distribution, model_names("distribution")));
}

decltype(FresnelStage::add) find_fresnel_stage(const std::string& name) {
  if (name.empty()) return add_terms;
  if (name == dielectric_share) return add_dielectric_share;
  if (name == schlick_share) return add_schlick_share;
  decltype(FresnelStage::add) found = nullptr;
  Fresnels::for_each([&]<template <class> class Model>() {
    if (Model<double>::name == kebab(name)) found = add_reflectance<Model>;
  });
  if (!found) throw Error(Fault::Usage, unknown_name("fresnel", name, model_names("fresnel")));
  return found;
}

}  // namespace kiln

// SPDX-License-Identifier: Apache-2.0
#include "preview_stages.h"

#include <type_traits>

#include "kiln/core/error.h"

namespace kiln {
namespace {

using F = WideFloat;

constexpr float most_f0 = 0.999f;  // of models whose index of refraction grows without bound

// What the model reads, where it is not F0 itself: the index of a dielectric of that F0, or n and k
// by Gulbrandsen's mapping.
template <template <class> class Model>
FresnelChannel<F> channel_of(const FresnelChannel<float>& numbers, F f0) {
  FresnelChannel<F> channel{f0,
                            F(numbers.f90),
                            F(numbers.f82),
                            F(numbers.edge_tint),
                            F(numbers.ior),
                            F(numbers.extinction),
                            F(numbers.dip),
                            F(numbers.exponent)};
  const F r = clamp(f0, F(0.0f), F(most_f0));
  if constexpr (std::is_same_v<Model<F>, Dielectric<F>>) {
    channel.ior = (F(1.0f) + sqrt(r)) / (F(1.0f) - sqrt(r));
  } else if constexpr (std::is_same_v<Model<F>, Conductor<F>> ||
                       std::is_same_v<Model<F>, Lazanyi<F>>) {
    channel.f0 = r;
    const Conductor<F> metal = Gulbrandsen<F>::make(channel).metal;
    channel.ior = metal.ior;
    channel.extinction = metal.extinction;
  }
  return channel;
}

template <template <class> class Model>
constexpr bool is_dipped = std::is_base_of_v<DippedSchlick<F>, Model<F>>;

// The average of c (1 - c)^6 over the hemisphere is 1/126.
template <template <class> class Model>
ChannelTerms terms_of(const Model<F>& model) {
  if constexpr (std::is_same_v<Model<F>, Schlick<F>>) {
    return {model.f0, model.f90, F(0.0f), model.average()};
  } else if constexpr (is_dipped<Model>) {
    return {model.f0, model.f90, model.dip, model.average()};
  } else {
    const F f0 = model.eval(F(1.0f)), f90 = model.eval(F(0.0f)), average = model.average();
    return {f0, f90, F(126.0f) * (lerp(f0, f90, F(1.0f / 21)) - average), average};
  }
}

// F0 scale + F90 bias - dip edge, see LobeTerms.
F by_terms(const ChannelTerms& channel, const DirectionTerms& terms) {
  const F schlick = fma(channel.f0, terms.split.scale, channel.f90 * terms.split.bias);
  return max(fma(-channel.dip, terms.edge, schlick), F(0.0f));
}

// The cosine of whose (1 - c)^5 the lobe has the mean.
F effective_cosine(const SplitSumTerms<F>& split) {
  const F weight = clamp(split.bias / max(split.total(), F(1e-9f)), F(1e-9f), F(1.0f));
  return F(1.0f) - exp(F(0.2f) * log(weight));
}

// Reflectance of the single-bounce lobe toward one direction. Schlick's form and the models with a
// dip that is not clamped are exact. For the others it is E F(c) with c the effective cosine: exact
// for a mirror and wherever F is linear in (1 - c)^5. For GGX and Beckmann with correlated Smith
// masking, over every roughness and mu >= 0.1 that errs by at most 0.013 for dielectrics of F0 0.02
// to 0.1 and 0.052 for metals of F0 0.5 to 0.95 with any edge tint. It steers energy and coupling;
// the lobe that is rendered is exact. Averages over directions are by_terms.
template <template <class> class Model>
F single_toward(const Model<F>& model, const ChannelTerms& channel, const DirectionTerms& terms) {
  if constexpr (std::is_same_v<Model<F>, Schlick<F>> || is_dipped<Model>) {
    return by_terms(channel, terms);
  } else {
    return terms.split.total() * model.eval(effective_cosine(terms.split));
  }
}

template <template <class> class Model>
PerChannel<Model<F>> models_of(const StagedPoint& point) {
  return PerChannel<Model<F>>::make(point.fresnel[0], point.fresnel[1], point.fresnel[2]);
}

template <template <class> class Model>
WideVec singles_toward(const PerChannel<Model<F>>& fresnel, const StagedPoint& point,
                       const DirectionTerms& terms) {
  return {single_toward<Model>(fresnel.x, point.channels[0], terms),
          single_toward<Model>(fresnel.y, point.channels[1], terms),
          single_toward<Model>(fresnel.z, point.channels[2], terms)};
}

template <template <class> class Model>
void set_fresnel(const FresnelChannel<float>& numbers, const WideVec& f0, StagedPoint& point) {
  point.fresnel = {channel_of<Model>(numbers, f0.x), channel_of<Model>(numbers, f0.y),
                   channel_of<Model>(numbers, f0.z)};
  const auto fresnel = models_of<Model>(point);
  point.channels = {terms_of<Model>(fresnel.x), terms_of<Model>(fresnel.y),
                    terms_of<Model>(fresnel.z)};
  point.single_o = singles_toward<Model>(fresnel, point, point.terms_o);
  point.single_average = {by_terms(point.channels[0], point.average),
                          by_terms(point.channels[1], point.average),
                          by_terms(point.channels[2], point.average)};
}

template <template <class> class Model>
void add_fresnel(const StagedPoint& point, DirectionBlock& block) {
  const auto fresnel = models_of<Model>(point);
  for (int i = 0; i < block.count; ++i) {
    block.specular[i] = fresnel.eval(block.cosine[i]);
    block.single[i] = singles_toward<Model>(fresnel, point, block.terms[i]);
  }
}

template <template <class> class Model>
void add_diffuse(const StagedPoint& point, DirectionBlock& block) {
  const Model<F> model{point.diffuse_color, point.roughness};
  for (int i = 0; i < block.count; ++i) block.diffuse[i] = model.eval(point.wo, block.wi[i]);
}

template <template <class> class Model>
WideVec diffuse_albedo(const StagedPoint& point) {
  return Model<F>{point.diffuse_color, point.roughness}.albedo(point.wo.z);
}

void choose_fresnel(const SurfaceChoice& surface, SurfaceStages& stages) {
  Fresnels::for_each([&]<template <class> class Model>() {
    if (Model<F>::name != surface.fresnel) return;
    stages.set_fresnel = set_fresnel<Model>;
    stages.add_fresnel = add_fresnel<Model>;
  });
  if (!stages.add_fresnel) {
    throw Error(Fault::Usage, unknown_name("fresnel", surface.fresnel, model_names("fresnel")));
  }
}

void choose_diffuse(const SurfaceChoice& surface, SurfaceStages& stages) {
  Diffuses::for_each([&]<template <class> class Model>() {
    if (Model<F>::name != surface.diffuse) return;
    stages.add_diffuse = add_diffuse<Model>;
    stages.diffuse_albedo = diffuse_albedo<Model>;
  });
  if (!stages.add_diffuse) {
    throw Error(Fault::Usage, unknown_name("diffuse", surface.diffuse, model_names("diffuse")));
  }
}

}  // namespace

SurfaceStages make_stages(const SurfaceChoice& surface) {
  SurfaceStages stages;
  choose_lobe(surface, stages);
  choose_fresnel(surface, stages);
  choose_diffuse(surface, stages);
  choose_energy(surface, stages);
  stages.numbers.f90 = static_cast<float>(surface.f90);
  stages.numbers.f82 = static_cast<float>(surface.f82);
  stages.numbers.edge_tint = static_cast<float>(surface.edge_tint);
  stages.numbers.dip = static_cast<float>(surface.dip);
  stages.numbers.exponent = static_cast<float>(surface.exponent);
  return stages;
}

}  // namespace kiln

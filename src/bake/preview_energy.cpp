// SPDX-License-Identifier: Apache-2.0
#include "kiln/core/error.h"
#include "preview_stages.h"

namespace kiln {
namespace {

using F = WideFloat;

// A lobe that reflects more than it receives has nothing to compensate: E counts as 1 there.
SplitSumTerms<F> bounded(const SplitSumTerms<F>& split) {
  return {min(split.total(), F(1.0f)), F(0.0f)};
}

SplitSumTerms<F> bounded_average(const StagedPoint& point) {
  return {point.bounded_average, F(0.0f)};
}

using Channels = std::array<ChannelEnergy<F>, 3>;

Channels channels_of(const StagedPoint& point, const WideVec& single) {
  const auto channel = [&](int c, F reflectance) -> ChannelEnergy<F> {
    return {point.channels[c].f0, point.channels[c].average, reflectance};
  };
  return {channel(0, single.x), channel(1, single.y), channel(2, single.z)};
}

// What the lobe reflects in total toward a direction of albedo e, per channel.
template <class Energy>
WideVec total_toward(const Channels& channels, const SplitSumTerms<F>& e,
                     const SplitSumTerms<F>& average) {
  const Albedo<F> albedo{e, e, average};
  return {Energy::total(channels[0], albedo), Energy::total(channels[1], albedo),
          Energy::total(channels[2], albedo)};
}

template <class Energy>
void set_energy(StagedPoint& point) {
  const SplitSumTerms<F> average = bounded_average(point);
  point.total_o = total_toward<Energy>(channels_of(point, point.single_o),
                                       bounded(point.terms_o.split), average);
  point.total_average =
      total_toward<Energy>(channels_of(point, point.single_average), average, average);
}

template <class Energy>
F with_energy(F single, const ChannelEnergy<F>& channel, const Albedo<F>& albedo) {
  return fma(single, Energy::scale(channel, albedo), Energy::added(channel, albedo));
}

template <class Energy>
void add_energy(const StagedPoint& point, DirectionBlock& block) {
  const SplitSumTerms<F> average = bounded_average(point);
  const Channels channels = channels_of(point, point.single_o);
  Albedo<F> albedo{bounded(point.terms_o.split), {}, average};
  for (int i = 0; i < block.count; ++i) {
    albedo.i = bounded(block.terms[i].split);
    const WideVec single = block.specular[i] * block.lobe[i];
    block.specular[i] = {with_energy<Energy>(single.x, channels[0], albedo),
                         with_energy<Energy>(single.y, channels[1], albedo),
                         with_energy<Energy>(single.z, channels[2], albedo)};
    const Channels back = channels_of(point, block.single[i]);
    block.reflectance[i] = max_component(total_toward<Energy>(back, albedo.i, average));
  }
}

// The lists' couplings read reflectances as split-sum terms; with F0 = 1 and F90 = 0 the term
// `scale` is the reflectance itself.
template <class Coupling, bool constant_albedo>
void couple(const StagedPoint& point, DirectionBlock& block) {
  const SpecularChannel<F> itself{F(1.0f), F(0.0f), F(0.0f)};
  Albedo<F> albedo{};
  albedo.o = {max_component(point.total_o), F(0.0f)};
  albedo.average = {max_component(point.total_average), F(0.0f)};
  for (int i = 0; i < block.count; ++i) {
    albedo.i = {block.reflectance[i], F(0.0f)};
    block.diffuse[i] = block.diffuse[i] * Coupling::weight(itself, albedo, constant_albedo);
  }
}

bool has_constant_albedo(const std::string& diffuse) {
  bool constant = false;
  Diffuses::for_each([&]<template <class> class Model>() {
    if (Model<F>::name == diffuse) constant = Model<F>::constant_albedo;
  });
  return constant;
}

}  // namespace

void choose_energy(const SurfaceChoice& surface, SurfaceStages& stages) {
  Energies::for_each([&]<template <class> class Model>() {
    if (Model<F>::name != surface.energy) return;
    stages.set_energy = set_energy<Model<F>>;
    stages.add_energy = add_energy<Model<F>>;
  });
  const bool constant = has_constant_albedo(surface.diffuse);
  Couplings::for_each([&]<template <class> class Model>() {
    if (Model<F>::name != surface.coupling) return;
    stages.couple = constant ? couple<Model<F>, true> : couple<Model<F>, false>;
  });
  if (!stages.add_energy) {
    throw Error(Fault::Usage, unknown_name("energy", surface.energy, model_names("energy")));
  }
  if (!stages.couple) {
    throw Error(Fault::Usage, unknown_name("coupling", surface.coupling, model_names("coupling")));
  }
}

}  // namespace kiln

// SPDX-License-Identifier: Apache-2.0
#include "kiln/core/error.h"
#include "preview_stages.h"

namespace kiln {
namespace {

using F = WideFloat;

// A lobe that reflects more than it receives has nothing to compensate: E counts as 1 there.
SplitSumTerms<F> bounded(const DirectionTerms& terms) {
  return {min(terms.split.total(), F(1.0f)), F(0.0f)};
}

ChannelEnergy<F> energy_of(const ChannelTerms& channel, const DirectionTerms& terms) {
  return {channel.f0, channel.average, reflectance_of(channel, terms)};
}

F component(const WideVec& v, int c) { return c == 0 ? v.x : c == 1 ? v.y : v.z; }

// What the lobe reflects in total toward the direction of these terms, per channel.
template <class Energy>
WideVec total_toward(const StagedPoint& point, const DirectionTerms& terms,
                     const SplitSumTerms<F>& average) {
  const SplitSumTerms<F> e = bounded(terms);
  const Albedo<F> albedo{e, e, average};
  const auto total = [&](int c) {
    return Energy::total(energy_of(point.channels[c], terms), albedo);
  };
  return {total(0), total(1), total(2)};
}

template <class Energy>
void set_energy(StagedPoint& point) {
  const SplitSumTerms<F> average = bounded(point.average);
  point.total_o = total_toward<Energy>(point, point.terms_o, average);
  point.total_average = total_toward<Energy>(point, point.average, average);
}

template <class Energy>
void add_energy(const StagedPoint& point, const AlbedoTable& table, DirectionBlock& block) {
  const SplitSumTerms<F> e_o = bounded(point.terms_o), average = bounded(point.average);
  const std::array<ChannelEnergy<F>, 3> channels = {energy_of(point.channels[0], point.terms_o),
                                                    energy_of(point.channels[1], point.terms_o),
                                                    energy_of(point.channels[2], point.terms_o)};
  for (int i = 0; i < block.count; ++i) {
    const F mu = block.wi[i].z;
    const DirectionTerms terms{table.terms(point.row, mu), table.edge(point.row, mu)};
    const Albedo<F> albedo{e_o, bounded(terms), average};
    const auto specular = [&](int c) {
      const F single = component(block.specular[i], c) * block.lobe[i];
      return fma(single, Energy::scale(channels[c], albedo), Energy::added(channels[c], albedo));
    };
    block.specular[i] = {specular(0), specular(1), specular(2)};
    block.reflectance[i] = max_component(total_toward<Energy>(point, terms, average));
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

// SPDX-License-Identifier: Apache-2.0
#include "kiln/brdf/models.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "kiln/core/error.h"

namespace kiln {
namespace {

template <class M>
ModelFacts facts_of_model(const std::string& family) {
  ModelFacts facts{family, std::string(M::name), std::string(M::summary), std::string(M::source)};
  if constexpr (requires { M::params; }) facts.params.assign(M::params.begin(), M::params.end());
  if constexpr (requires { M::reciprocal; }) facts.reciprocal = M::reciprocal;
  if constexpr (requires { M::anisotropic; }) facts.anisotropic = M::anisotropic;
  if constexpr (requires { M::has_lambda; }) facts.has_lambda = M::has_lambda;
  if constexpr (requires { M::exact_lambda; }) facts.exact_lambda = M::exact_lambda;
  if constexpr (requires { M::one_sided; }) facts.one_sided = M::one_sided;
  if constexpr (requires { M::greatest_albedo; }) facts.greatest_albedo = M::greatest_albedo;
  return facts;
}

template <class List>
void append(std::vector<ModelFacts>& facts, const std::string& family) {
  List::for_each([&]<template <class> class Model>() {
    facts.push_back(facts_of_model<Model<double>>(family));
  });
}

std::vector<ModelFacts> collect() {
  std::vector<ModelFacts> facts;
  append<Distributions>(facts, "distribution");
  append<Maskings>(facts, "masking");
  append<Fresnels>(facts, "fresnel");
  append<Diffuses>(facts, "diffuse");
  append<Energies>(facts, "energy");
  append<Couplings>(facts, "coupling");
  return facts;
}

void require_listed(const std::string& family, std::string_view name) {
  const std::vector<std::string> known = model_names(family);
  if (std::find(known.begin(), known.end(), kebab(name)) == known.end()) {
    throw Error(Fault::Usage, unknown_name(family, name, known));
  }
}

}  // namespace

const std::vector<ModelFacts>& all_models() {
  static const std::vector<ModelFacts> facts = collect();
  return facts;
}

std::vector<std::string> model_names(std::string_view family) {
  std::vector<std::string> names;
  for (const ModelFacts& model : all_models()) {
    if (model.family == family) names.push_back(model.name);
  }
  return names;
}

std::vector<std::string> fitting_maskings(std::string_view distribution) {
  std::vector<std::string> names;
  for_each_lobe([&]<template <class> class Distribution, template <class> class Masking>() {
    if (Distribution<double>::name == distribution) names.emplace_back(Masking<double>::name);
  });
  return names;
}

void refuse_lobe(std::string_view distribution, std::string_view masking) {
  require_listed("distribution", distribution);
  require_listed("masking", masking);
  throw Error(
      Fault::Usage,
      fmt::format("masking '{}' does not fit distribution '{}', expected one of {}", masking,
                  distribution, fmt::join(fitting_maskings(kebab(distribution)), ", ")));
}

}  // namespace kiln

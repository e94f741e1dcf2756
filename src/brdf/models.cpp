// SPDX-License-Identifier: Apache-2.0
#include "kiln/brdf/models.h"

namespace kiln {
namespace {

template <class List>
void append(std::vector<ModelFacts>& facts, const std::string& family) {
  List::for_each([&]<template <class> class Model>() {
    using M = Model<double>;
    facts.push_back(
        {family, std::string(M::name), std::string(M::summary), std::string(M::source)});
  });
}

std::vector<ModelFacts> collect() {
  std::vector<ModelFacts> facts;
  append<Distributions>(facts, "distribution");
  append<Maskings>(facts, "masking");
  append<Fresnels>(facts, "fresnel");
  append<Diffuses>(facts, "diffuse");
  return facts;
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

}  // namespace kiln

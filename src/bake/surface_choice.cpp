// SPDX-License-Identifier: Apache-2.0
#include "kiln/bake/surface_choice.h"

#include <fmt/format.h>

#include <algorithm>

#include "kiln/brdf/models.h"
#include "kiln/table/lobe.h"

namespace kiln {
namespace {

using Text = std::string SurfaceChoice::*;

// Words that mean another one.
struct Alias {
  const char* word;
  const char* meaning;
};

Param<SurfaceChoice> choice_param(std::string name, Text member, std::vector<std::string> choices,
                                  std::string meaning, const std::vector<Alias>& aliases = {}) {
  for (const Alias& alias : aliases) choices.emplace_back(alias.word);
  ParamFacts facts{std::move(name),
                   ParamFacts::Kind::Word,
                   SurfaceChoice{}.*member,
                   0,
                   0,
                   std::move(choices),
                   "",
                   std::move(meaning)};
  return {facts, [facts, member, aliases](SurfaceChoice& surface, const std::string& text) {
            std::string word = facts.choices[parse_word(facts, text)];
            for (const Alias& alias : aliases) {
              if (word == alias.word) word = alias.meaning;
            }
            surface.*member = word;
          }};
}

Param<SurfaceChoice> model_param(const char* family, Text member, std::string meaning,
                                 const std::vector<Alias>& aliases = {}) {
  return choice_param(family, member, model_names(family), std::move(meaning), aliases);
}

}  // namespace

Params<SurfaceChoice> surface_params() {
  using S = SurfaceChoice;
  return {
      choice_param("bsdf", &S::bsdf, {"opaque", "glass"},
                   "a surface that reflects, or a rough dielectric that one sees through"),
      model_param("distribution", &S::distribution, "distribution of microfacet normals"),
      model_param("masking", &S::masking, "masking and shadowing"),
      model_param("fresnel", &S::fresnel, "Fresnel reflectance, from the F0 of the maps"),
      model_param("diffuse", &S::diffuse, "diffuse reflection"),
      model_param("energy", &S::energy, "energy of light that scatters more than once",
                  {{"multiscatter", "kulla-conty"}, {"single", "none"}}),
      model_param("coupling", &S::coupling, "how diffuse light makes room for specular"),
      number_param("distribution_shape", &S::distribution_shape, {0, 40}, "",
                   "tail of gtr and student-t; 0: the model's default"),
      number_param("f90", &S::f90, {0, 1}, "",
                   "reflectance at grazing incidence: schlick, f82-tint, hoffman-f82"),
      number_param("f82", &S::f82, {0, 1}, "",
                   "at 82 degrees, tint of f82-tint or reflectance of hoffman-f82"),
      number_param("edge_tint", &S::edge_tint, {0, 1}, "",
                   "bias of n and k found from F0: conductor, gulbrandsen, lazanyi"),
      number_param("dip", &S::dip, {-20, 20}, "", "scale of lazanyi's error term"),
      number_param("exponent", &S::exponent, {1, 20}, "", "exponent of lazanyi's error term"),
      number_param("ior", &S::ior, {0.1, 10}, "", "refractive index of glass"),
  };
}

void check_surface(const SurfaceChoice& surface) {
  with_lobe(surface.distribution, surface.masking,
            []<template <class> class Distribution, template <class> class Masking>() {});
  // The lobe's own check of its shape.
  LobeIntegrals({surface.distribution, surface.masking, surface.distribution_shape}, {},
                Quality::Table);
}

std::string surface_words(const SurfaceChoice& s) {
  if (s.bsdf == "glass") {
    return fmt::format("bsdf=glass distribution=ggx masking=smith-correlated ior={}", s.ior);
  }
  return fmt::format("distribution={} masking={} fresnel={} diffuse={} energy={} coupling={}",
                     s.distribution, s.masking, s.fresnel, s.diffuse, s.energy, s.coupling);
}

}  // namespace kiln

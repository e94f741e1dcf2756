// SPDX-License-Identifier: Apache-2.0
#include "candidates.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "kiln/brdf/burley.h"
#include "kiln/brdf/models.h"
#include "kiln/math/vec.h"
#include "kiln/table/ltc.h"

namespace kiln::validate {
namespace {

double burley_albedo(double mu, double alpha) {
  return Burley<double>{{1, 1, 1}, std::sqrt(alpha)}.albedo(mu).x;
}

bool is_common(const Lobe& lobe) {
  static constexpr std::array<std::string_view, 5> of_ggx{
      "smith-correlated", "smith-separable", "schlick-ggx", "schlick-ggx-direct", "hammon"};
  if (lobe.distribution == "ggx") {
    return std::find(of_ggx.begin(), of_ggx.end(), lobe.masking) != of_ggx.end();
  }
  return lobe.distribution == "beckmann" && lobe.masking.starts_with("smith");
}

// Unreal's joint masking is Hammon's. Cloth has maskings of its own, and nobody tabulates lobes
// without a mirror's limit of 1.
bool is_tried(const Lobe& lobe) {
  if (lobe.distribution == "charlie") {
    return lobe.masking.starts_with("neubelt") || lobe.masking == "estevez-kulla";
  }
  if (lobe.distribution == "phong") return lobe.masking.starts_with("smith");
  if (lobe.distribution == "beckmann" && !is_common(lobe)) {
    return lobe.masking == "v-cavity" || lobe.masking == "schlick-beckmann";
  }
  return lobe.masking != "kelemen" && lobe.masking != "neumann" && lobe.masking != "implicit" &&
         lobe.masking != "unreal-joint" && !lobe.masking.starts_with("neubelt");
}

std::vector<TriedLobe> make_lobes() {
  std::vector<TriedLobe> lobes;
  for_each_lobe([&]<template <class> class Distribution, template <class> class Masking>() {
    if constexpr (!requires { Distribution<double>::default_shape; }) {
      const Lobe lobe{std::string(Distribution<double>::name), std::string(Masking<double>::name)};
      const bool sheen = lobe.distribution == "charlie";
      if (is_tried(lobe)) lobes.push_back({lobe, sheen, !sheen && !is_common(lobe)});
    }
  });
  return lobes;
}

}  // namespace

const std::vector<TriedLobe>& tried_lobes() {
  static const std::vector<TriedLobe> lobes = make_lobes();
  return lobes;
}

std::string_view words(Meaning meaning) {
  switch (meaning) {
    case Meaning::Scale:
      return "scale";
    case Meaning::Bias:
      return "bias";
    case Meaning::Albedo:
      return "albedo";
    case Meaning::Loss:
      return "1 - albedo";
    case Meaning::Edge:
      return "edge term c (1 - c)^6";
    case Meaning::EdgeTimesSixteen:
      return "16 times the edge term c (1 - c)^6";
    case Meaning::AlbedoOverTwoPi:
      return "albedo / (2 pi)";
    case Meaning::BiasOverTwoPi:
      return "bias / (2 pi)";
    case Meaning::Burley:
      return "albedo of Burley's diffuse";
    case Meaning::BurleyLessHalf:
      return "albedo of Burley's diffuse - 0.5";
    case Meaning::UnityDisney:
      return "albedo of Burley's diffuse / 1.03571 - 0.5";
    case Meaning::FabricLambert:
      return "1 - alpha / 2, Lambert's fabric";
    case Meaning::SphereFormFactor:
      return "form factor of a sphere clipped by the horizon";
  }
  return "unknown";
}

std::span<const Meaning> meanings_of_specular() {
  static constexpr std::array list{Meaning::Scale, Meaning::Bias, Meaning::Albedo,
                                   Meaning::Loss,  Meaning::Edge, Meaning::EdgeTimesSixteen};
  return list;
}

std::span<const Meaning> meanings_of_sheen() {
  static constexpr std::array list{Meaning::Albedo, Meaning::AlbedoOverTwoPi, Meaning::Bias,
                                   Meaning::BiasOverTwoPi};
  return list;
}

std::span<const Meaning> meanings_without_lobe() {
  static constexpr std::array list{Meaning::Burley, Meaning::BurleyLessHalf, Meaning::UnityDisney,
                                   Meaning::FabricLambert, Meaning::SphereFormFactor};
  return list;
}

double value_of(Meaning meaning, const LobeTerms& terms, double mu, double alpha) {
  switch (meaning) {
    case Meaning::Scale:
      return terms.scale;
    case Meaning::Bias:
      return terms.bias;
    case Meaning::Albedo:
      return terms.total();
    case Meaning::Loss:
      return 1 - terms.total();
    case Meaning::Edge:
      return terms.edge;
    case Meaning::EdgeTimesSixteen:
      return 16 * terms.edge;
    case Meaning::AlbedoOverTwoPi:
      return terms.total() / (2 * pi);
    case Meaning::BiasOverTwoPi:
      return terms.bias / (2 * pi);
    case Meaning::Burley:
      return burley_albedo(mu, alpha);
    case Meaning::BurleyLessHalf:
      return burley_albedo(mu, alpha) - 0.5;
    // Divided by its greatest value seen from straight above, and stored less 1/2.
    case Meaning::UnityDisney:
      return burley_albedo(mu, alpha) / 1.03571 - 0.5;
    case Meaning::FabricLambert:
      return 1 - alpha / 2;
    // It lies beside the albedos of transformed cosines, where the axes are sqrt(alpha) for the
    // middle of the sphere, (1 + cosine) / 2, and sqrt(1 - mu) for its squared sine.
    case Meaning::SphereFormFactor:
      return sphere_form_factor(2 * std::sqrt(alpha) - 1, std::sqrt(1 - mu));
  }
  return 0;
}

}  // namespace kiln::validate

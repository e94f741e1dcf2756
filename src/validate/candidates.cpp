// SPDX-License-Identifier: Apache-2.0
#include "candidates.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "kiln/math/vec.h"

namespace kiln::validate {
namespace {

// Albedo of Burley's diffuse over its colour, with a = (1 - mu)^5, d = r - 1/2, r = sqrt(alpha).
// Derived from Burley 2012: f = rho / pi (1 + (F90-1)(1-mu_i)^5)(1 + (F90-1)(1-mu_o)^5),
// F90 = 1/2 + 2 r c^2, and c^2 is linear in cos(phi).
double burley_albedo(double mu, double alpha) {
  const double r = std::sqrt(alpha), d = r - 0.5, a = std::pow(1 - mu, 5);
  const double squared = d * d / 42 + 2 * d * r * mu / 168 + r * r * mu * mu / 504 +
                         r * r * (1 - mu * mu) * (1.0 / 42 - 1.0 / 504) / 2;
  return 1 + 2 * (d / 42 + r * mu / 168 + a * (d / 2 + r * mu / 3) + a * squared);
}

}  // namespace

const std::vector<Model>& all_models() {
  static const std::vector<Model> models{{{"ggx", "smith-correlated", 0}, false}};
  return models;
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
    case Meaning::ClampedAlbedo:
      return "albedo clamped to 1";
    case Meaning::AlbedoOverTwoPi:
      return "albedo / (2 pi)";
    case Meaning::BiasOverTwoPi:
      return "bias / (2 pi)";
    case Meaning::Burley:
      return "albedo of Burley's diffuse";
    case Meaning::BurleyLessHalf:
      return "albedo of Burley's diffuse - 0.5";
  }
  return "unknown";
}

std::span<const Meaning> meanings_of_specular() {
  static constexpr std::array list{Meaning::Scale, Meaning::Bias, Meaning::Albedo, Meaning::Loss};
  return list;
}

std::span<const Meaning> meanings_of_sheen() {
  static constexpr std::array list{Meaning::Albedo, Meaning::ClampedAlbedo,
                                   Meaning::AlbedoOverTwoPi, Meaning::Bias, Meaning::BiasOverTwoPi};
  return list;
}

std::span<const Meaning> meanings_of_diffuse() {
  static constexpr std::array list{Meaning::Burley, Meaning::BurleyLessHalf};
  return list;
}

double value_of(Meaning meaning, const SplitSumTerms<double>& terms, double mu, double alpha) {
  switch (meaning) {
    case Meaning::Scale:
      return terms.scale;
    case Meaning::Bias:
      return terms.bias;
    case Meaning::Albedo:
      return terms.total();
    case Meaning::Loss:
      return 1 - terms.total();
    case Meaning::ClampedAlbedo:
      return std::min(terms.total(), 1.0);
    case Meaning::AlbedoOverTwoPi:
      return terms.total() / (2 * pi);
    case Meaning::BiasOverTwoPi:
      return terms.bias / (2 * pi);
    case Meaning::Burley:
      return burley_albedo(mu, alpha);
    case Meaning::BurleyLessHalf:
      return burley_albedo(mu, alpha) - 0.5;
  }
  return 0;
}

}  // namespace kiln::validate

// SPDX-License-Identifier: Apache-2.0
#include "kiln/validate/model_measure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "kiln/brdf/models.h"
#include "kiln/integrate/gauss_legendre.h"
#include "kiln/table/diffuse_albedo.h"

namespace kiln {
namespace {

constexpr std::array measured_mus{1e-3, 0.01, 0.05, 0.1, 0.25, 0.5, 0.75, 1.0};
constexpr std::array measured_roughness{0.1, 0.2, 0.35, 0.5, 0.7, 0.85, 1.0};

// INT G1 max(0, o.m) D dm / mu over slopes about the normal: the azimuth p of m from the view by
// midpoints, the slope t = tan(theta) = sinh x by Gauss's rule up to where the facet turns away,
// t cos p = -mu / sine; dm = t dt dp / (1 + t^2)^(3/2).
template <class Masking, class Distribution>
double visible_area(const Distribution& distribution, double mu) {
  static const Rule rule = gauss_legendre(48);
  constexpr int azimuths = 48;
  const double sine = std::sqrt((1 - mu) * (1 + mu));
  const Vec3<double> wo{sine, 0.0, mu};
  double sum = 0;
  for (int k = 0; k < azimuths; ++k) {
    const double p = pi * (k + 0.5) / azimuths, c = std::cos(p);
    const double last = c < 0 ? std::min(-mu / std::min(sine * c, -1e-12), 1e6) : 1e6;
    const double reach = std::asinh(last / distribution.alpha_x);
    for (size_t j = 0; j < rule.nodes.size(); ++j) {
      const double x = reach * rule.nodes[j], t = distribution.alpha_x * std::sinh(x);
      const double z = 1 / std::sqrt(1 + t * t);
      const Vec3<double> wm{t * c * z, t * std::sin(p) * z, z};
      const double facing = std::max(dot(wo, wm), 0.0);
      sum += rule.weights[j] * reach * distribution.alpha_x * std::cosh(x) * t * z * z * z *
             Masking::G1(distribution, wo, wm) * facing * distribution.D(wm);
    }
  }
  return sum * 2 * pi / azimuths / mu;
}

std::optional<ValueRange> weak_furnace_of(const Lobe& lobe) {
  std::optional<ValueRange> found;
  with_lobe(lobe.distribution, lobe.masking,
            [&]<template <class> class Distribution, template <class> class Masking>() {
              if constexpr (Masking<double>::one_sided) {
                found = ValueRange{1e9, -1e9};
                for (const double roughness : measured_roughness) {
                  const double alpha = roughness * roughness;
                  const auto one =
                      make_distribution<Distribution<double>, double>(alpha, alpha, lobe.shape);
                  for (const double mu : measured_mus) {
                    const double area = visible_area<Masking<double>>(one, mu);
                    found->least = std::min(found->least, area);
                    found->greatest = std::max(found->greatest, area);
                  }
                }
              }
            });
  return found;
}

Vec3<double> direction(double mu, double azimuth) {
  const double sine = std::sqrt((1 - mu) * (1 + mu));
  return {sine * std::cos(azimuth), sine * std::sin(azimuth), mu};
}

// Greatest |f(i, o) - f(o, i)| / f(i, o) of D and G2 over pairs of directions.
double asymmetry_of(const Lobe& lobe) {
  double greatest = 0;
  with_lobe(lobe.distribution, lobe.masking,
            [&]<template <class> class Distribution, template <class> class Masking>() {
              const auto one =
                  make_distribution<Distribution<double>, double>(0.3, 0.3, lobe.shape);
              const auto value = [&](const Vec3<double>& wo, const Vec3<double>& wi) {
                const Vec3<double> wm = normalize(wo + wi);
                return one.D(wm) * Masking<double>::visibility(one, wo, wi, wm);
              };
              for (const double mu_o : measured_mus) {
                for (const double mu_i : measured_mus) {
                  const Vec3<double> wo = direction(mu_o, 0), wi = direction(mu_i, 2);
                  const double there = value(wo, wi), back = value(wi, wo);
                  greatest = std::max(greatest, std::abs(there - back) / std::max(there, 1e-30));
                }
              }
            });
  return greatest;
}

}  // namespace

LobeMeasure measure_lobe(const Lobe& lobe) {
  LobeMeasure measure;
  measure.weak_furnace = weak_furnace_of(lobe);
  measure.asymmetry = asymmetry_of(lobe);
  std::vector<double> alphas;
  alphas.reserve(measured_roughness.size());
  for (const double roughness : measured_roughness) alphas.push_back(roughness * roughness);
  const auto terms = LobeIntegrals(lobe, {}, Quality::Table).grid(measured_mus, alphas);
  for (size_t i = 0; i < terms.size(); ++i) {
    if (terms[i].total() <= measure.greatest_albedo) continue;
    measure.greatest_albedo = terms[i].total();
    measure.mu = measured_mus[i % measured_mus.size()];
    measure.roughness = measured_roughness[i / measured_mus.size()];
  }
  return measure;
}

DiffuseMeasure measure_diffuse(const std::string& model) {
  DiffuseMeasure measure;
  for (int j = 0; j <= 5; ++j) {
    for (const double mu : measured_mus) {
      const double albedo = integrate_diffuse({model, j / 5.0, 1}, mu, 12);
      if (albedo <= measure.greatest_albedo) continue;
      measure = {albedo, mu, j / 5.0};
    }
  }
  return measure;
}

}  // namespace kiln

// SPDX-License-Identifier: Apache-2.0
#include "kiln/table/diffuse_albedo.h"

#include <algorithm>
#include <cmath>

#include "kiln/brdf/models.h"
#include "kiln/core/error.h"
#include "kiln/core/names.h"
#include "kiln/integrate/gauss_legendre.h"

namespace kiln {
namespace {

using Wide = WideDouble;
constexpr int lanes = lane_count<Wide>;
constexpr double lowest_mu = 1e-4;

// Azimuths of a half circle, split at the right angle, with the weight of both half circles; whole
// vectors, padded by weight 0.
struct Azimuths {
  std::vector<double> cosine, sine, weight;
};

Azimuths make_azimuths(const Rule& rule) {
  const size_t n = rule.nodes.size(), padded = (2 * n + lanes - 1) / lanes * lanes;
  Azimuths azimuths;
  azimuths.cosine.assign(padded, 1.0);
  azimuths.sine.assign(padded, 0.0);
  azimuths.weight.assign(padded, 0.0);
  for (size_t i = 0; i < 2 * n; ++i) {
    const double start = i < n ? 0 : pi / 2;
    const double phi = start + rule.nodes[i % n] * pi / 2;
    azimuths.cosine[i] = std::cos(phi);
    azimuths.sine[i] = std::sin(phi);
    azimuths.weight[i] = pi * rule.weights[i % n];
  }
  return azimuths;
}

// INT f dphi over the directions of one elevation.
template <class Model>
double integrate_circle(const Model& model, const Vec3<Wide>& wo, double elevation,
                        const Azimuths& azimuths) {
  const Wide up = Wide(std::sin(elevation)), along = Wide(std::cos(elevation));
  Wide sum = Wide(0.0);
  for (size_t k = 0; k < azimuths.weight.size(); k += lanes) {
    const Vec3<Wide> wi{along * load_lanes<Wide>(&azimuths.cosine[k]),
                        along * load_lanes<Wide>(&azimuths.sine[k]), up};
    sum = fma(load_lanes<Wide>(&azimuths.weight[k]), model.eval(wo, wi).x, sum);
  }
  double lane[lanes], total = 0;
  store_lanes(lane, sum);
  for (const double value : lane) total += value;
  return total;
}

// Elevations mu sinh x below and above that of wo.
template <class Model>
double integrate_model(const Model& model, double mu, const Rule& rule, const Azimuths& azimuths) {
  const double sine = std::sqrt((1 - mu) * (1 + mu));
  const Vec3<Wide> wo{Wide(sine), Wide(0.0), Wide(mu)};
  const double edges[] = {0, std::asinh(std::atan2(mu, sine) / mu), std::asinh(pi / 2 / mu)};
  double sum = 0;
  for (int piece = 0; piece < 2; ++piece) {
    const double from = edges[piece], span = edges[piece + 1] - from;
    for (size_t j = 0; j < rule.nodes.size(); ++j) {
      const double x = from + span * rule.nodes[j];
      const double elevation = mu * std::sinh(x);
      const double solid_angle = mu * std::cosh(x) * span * rule.weights[j] * std::cos(elevation);
      sum += solid_angle * std::sin(elevation) * integrate_circle(model, wo, elevation, azimuths);
    }
  }
  return sum;
}

// Calls visit(model) with the model of that name.
template <class Visit>
void with_diffuse(const DiffuseSurface& surface, Visit&& visit) {
  const std::string wanted = kebab(surface.model);
  bool found = false;
  Diffuses::for_each([&]<template <class> class Model>() {
    if (Model<Wide>::name != wanted) return;
    found = true;
    const Wide color = Wide(surface.color);
    visit(Model<Wide>{{color, color, color}, Wide(surface.roughness)});
  });
  if (!found) {
    throw Error(Fault::Usage, unknown_name("diffuse", surface.model, model_names("diffuse")));
  }
}

}  // namespace

double integrate_diffuse(const DiffuseSurface& surface, double mu, int order) {
  const Rule rule = gauss_legendre(order);
  const Azimuths azimuths = make_azimuths(rule);
  double albedo = 0;
  with_diffuse(surface, [&](const auto& model) {
    albedo = integrate_model(model, std::clamp(mu, lowest_mu, 1.0), rule, azimuths);
  });
  return albedo;
}

double integrate_diffuse_average(const DiffuseSurface& surface, int order) {
  const Rule rule = gauss_legendre(order);
  const Azimuths azimuths = make_azimuths(rule);
  double average = 0;
  with_diffuse(surface, [&](const auto& model) {
    // The elevation is pi/2 s^3: dense toward grazing, and smooth where mu is 1.
    for (size_t i = 0; i < rule.nodes.size(); ++i) {
      const double s = rule.nodes[i], elevation = pi / 2 * s * s * s;
      const double mu = std::sin(elevation);
      const double weight = std::sin(2 * elevation) * pi / 2 * 3 * s * s * rule.weights[i];
      average += weight * integrate_model(model, std::max(mu, lowest_mu), rule, azimuths);
    }
  });
  return average;
}

}  // namespace kiln

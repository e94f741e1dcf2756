// SPDX-License-Identifier: Apache-2.0
// Reference previews against deterministic truth, judged by the standard errors they state.
#include <gtest/gtest.h>

#include <functional>

#include "kiln/brdf/eon.h"
#include "kiln/brdf/lambert.h"
#include "kiln/brdf/models.h"
#include "kiln/brdf/roughness.h"
#include "kiln/brdf/surface.h"
#include "kiln/integrate/gauss_legendre.h"
#include "kiln/table/directional_albedo.h"
#include "support/directions.h"
#include "support/scenes.h"

namespace kiln {
namespace {

// A smooth sky, brighter toward one side: radiance the estimator has to integrate.
double sky(const Vec3<double>& d) { return std::exp(2 * (0.6 * d.x + 0.8 * d.z)); }

// INT f L cos over the hemisphere by quadrature in double, with exact split-sum terms.
template <class Diffuse>
double integrate_radiance(const test::Uniform& u, const Vec3<double>& wo) {
  const double alpha = to_alpha(static_cast<double>(u.roughness));
  const auto fresnel = schlick_of<double>({u.f0, u.f0, u.f0}, 1.0);
  const auto average = integrate_average(alpha);
  const auto surface = Surface<double, Diffuse>::make(
      alpha, fresnel, {{u.diffuse, u.diffuse, u.diffuse}, u.roughness}, average,
      Energy::Multiscatter);
  const auto terms_o = integrate_split_sum(wo.z, alpha);
  const Rule rule = gauss_legendre(96);
  constexpr int azimuths = 384;
  double sum = 0;
  for (size_t i = 0; i < rule.nodes.size(); ++i) {
    const auto terms_i = integrate_split_sum(rule.nodes[i], alpha);
    for (int j = 0; j < azimuths; ++j) {
      const Vec3<double> wi = test::direction(rule.nodes[i], 2 * pi * (j + 0.5) / azimuths);
      const Vec3<double> wm = half_vector(wo, wi);
      const auto f = surface.eval(wo, wi, wm, surface.ggx.D(wm), {terms_o, terms_i, average});
      sum += rule.weights[i] * (f.specular.x + f.diffuse.x * u.occlusion) * sky(wi) * wi.z;
    }
  }
  return sum * 2 * pi / azimuths;
}

struct Scene {
  test::Uniform material;
  const char* diffuse;
  double theta_deg;
};

TEST(ReferencePreview, MeetsTheIntegralWithinItsStatedError) {
  const std::vector<Scene> scenes = {
      {{.diffuse = 0.8f, .f0 = 0.04f, .roughness = 0.5f}, "lambert", 0},
      {{.diffuse = 0.8f, .f0 = 0.04f, .roughness = 0.5f, .occlusion = 0.5f}, "eon", 30},
      {{.diffuse = 0.0f, .f0 = 0.9f, .roughness = 0.4f}, "eon", 60},
      {{.diffuse = 0.5f, .f0 = 0.3f, .roughness = 1.0f}, "lambert", 75},
      {{.diffuse = 0.5f, .f0 = 0.5f, .roughness = 0.35f}, "eon", 45}};
  const Layers latlong = test::make_latlong({1024, 512}, sky);
  for (const Scene& scene : scenes) {
    const std::string view = std::to_string(scene.theta_deg) + ",0";
    const Layers image = test::preview(test::uniform_svbrdf(scene.material), latlong,
                                       {{"samples", "1024"}, {"view", view}}, scene.diffuse);
    const Vec3<double> wo = test::direction(std::cos(scene.theta_deg * pi / 180), 0);
    const double truth = std::string(scene.diffuse) == "eon"
                             ? integrate_radiance<Eon<double>>(scene.material, wo)
                             : integrate_radiance<Lambert<double>>(scene.material, wo);
    // 256 independent texels: their mean has a sixteenth of one texel's error. 6e-4 more is what
    // the albedo table may err by, and 4 standard errors is 0.03 % family-wise.
    const double error = test::mean(*image.find("stderr.R")) / 16;
    EXPECT_NEAR(test::mean(*image.find("R")), truth, 4 * error + 1e-3 * truth)
        << scene.diffuse << " at " << scene.theta_deg;
    EXPECT_LT(error, 1e-3 * truth);
  }
}

// Models that run in stages: the same integral with everything exact, for a grey surface.
struct ModelScene {
  SurfaceChoice surface;
  test::Uniform material;
  double theta_deg;
  double coupling_error = 1e-3;  ///< relative, of the tables and of an exact Fresnel's coupling
};

SurfaceChoice models(const char* distribution, const char* masking, const char* fresnel,
                     const char* diffuse) {
  SurfaceChoice surface;
  surface.distribution = distribution;
  surface.masking = masking;
  surface.fresnel = fresnel;
  surface.diffuse = diffuse;
  return surface;
}

// n and k of a channel from its F0, as the docs say.
FresnelChannel<double> channel_of(const SurfaceChoice& surface, double f0) {
  FresnelChannel<double> channel;
  channel.f0 = f0;
  channel.f90 = surface.f90;
  channel.f82 = surface.f82;
  channel.edge_tint = surface.edge_tint;
  channel.ior = (1 + std::sqrt(f0)) / (1 - std::sqrt(f0));
  if (surface.fresnel == "conductor") {
    const Conductor<double> metal = Gulbrandsen<double>::make(channel).metal;
    channel.ior = metal.ior;
    channel.extinction = metal.extinction;
  }
  return channel;
}

// What a scene's models make of it, in double.
struct ExactModels {
  LobeIntegrals plain, reflecting;
  double alpha;
  ChannelEnergy<double> channel{};
  SplitSumTerms<double> average;
  double average_reflectance;

  ExactModels(const SurfaceChoice& surface, const FresnelChannel<double>& fresnel, double width)
      : plain({surface.distribution, surface.masking}, {}, Quality::Table),
        reflecting({surface.distribution, surface.masking}, {surface.fresnel, fresnel},
                   Quality::Table),
        alpha(width) {
    const LobeTerms terms = plain.average(alpha);
    average = {terms.scale, terms.bias};
    average_reflectance = reflecting.average(alpha).scale;
    Fresnels::for_each([&]<template <class> class Model>() {
      if (Model<double>::name != surface.fresnel) return;
      const auto model = Model<double>::make(fresnel);
      channel = {model.eval(1.0), model.average(), 0};
    });
  }

  SplitSumTerms<double> terms(double mu) const {
    const LobeTerms found = plain.at({mu, alpha, alpha, 0});
    return {found.scale, found.bias};
  }
  ChannelEnergy<double> toward(double mu) const {
    ChannelEnergy<double> at = channel;
    at.reflectance = reflecting.at({mu, alpha, alpha, 0}).scale;
    return at;
  }
};

// Calls visit.operator()<Model>() for the model of that name.
template <class List, class Visit>
void with_model(const std::string& name, Visit&& visit) {
  List::for_each([&]<template <class> class Model>() {
    if (Model<double>::name == name) visit.template operator()<Model>();
  });
}

// F D V of the lobe, and the diffuse lobe, of two directions.
struct Lobes {
  std::function<double(const Vec3<double>&, const Vec3<double>&)> specular, diffuse;
};

Lobes lobes_of(const ModelScene& scene, const FresnelChannel<double>& channel, double alpha) {
  Lobes lobes;
  const test::Uniform& u = scene.material;
  with_lobe(scene.surface.distribution, scene.surface.masking,
            [&]<template <class> class Distribution, template <class> class Masking>() {
              with_model<Fresnels>(scene.surface.fresnel, [&]<template <class> class Fresnel>() {
                lobes.specular = [=](const Vec3<double>& wo, const Vec3<double>& wi) {
                  const auto d = make_distribution<Distribution<double>>(alpha, alpha, 0);
                  const Vec3<double> wm = half_vector(wo, wi);
                  return Fresnel<double>::make(channel).eval(dot(wo, wm)) * d.D(wm) *
                         Masking<double>::visibility(d, wo, wi, wm);
                };
              });
            });
  with_model<Diffuses>(scene.surface.diffuse, [&]<template <class> class Diffuse>() {
    lobes.diffuse = [=](const Vec3<double>& wo, const Vec3<double>& wi) {
      const Vec3<double> color{u.diffuse, u.diffuse, u.diffuse};
      return Diffuse<double>{color, u.roughness}.eval(wo, wi).x;
    };
  });
  return lobes;
}

double integrate_models(const ModelScene& scene, const Vec3<double>& wo) {
  const test::Uniform& u = scene.material;
  const double alpha = to_alpha(static_cast<double>(u.roughness));
  const FresnelChannel<double> channel = channel_of(scene.surface, u.f0);
  const ExactModels exact(scene.surface, channel, alpha);
  const Lobes lobes = lobes_of(scene, channel, alpha);
  const ChannelEnergy<double> energy_o = exact.toward(wo.z);
  const SplitSumTerms<double> terms_o = exact.terms(wo.z);
  const Rule rule = gauss_legendre(128);
  constexpr int azimuths = 512;
  double sum = 0;
  with_model<Energies>(scene.surface.energy, [&]<template <class> class Energy>() {
    with_model<Couplings>(scene.surface.coupling, [&]<template <class> class Coupling>() {
      using E = Energy<double>;
      const double total_o = E::total(energy_o, {terms_o, terms_o, exact.average});
      for (size_t i = 0; i < rule.nodes.size(); ++i) {
        const double mu = rule.nodes[i];
        const SplitSumTerms<double> terms_i = exact.terms(mu);
        const Albedo<double> albedo{terms_o, terms_i, exact.average};
        const double total_i = E::total(exact.toward(mu), {terms_i, terms_i, exact.average});
        const double weight = Coupling<double>::weight(
            {1, 0, 0}, {{total_o, 0}, {total_i, 0}, {exact.average_reflectance, 0}}, false);
        const double scale = E::scale(energy_o, albedo), added = E::added(energy_o, albedo);
        for (int j = 0; j < azimuths; ++j) {
          const Vec3<double> wi = test::direction(mu, 2 * pi * (j + 0.5) / azimuths);
          const double f =
              lobes.specular(wo, wi) * scale + added + lobes.diffuse(wo, wi) * weight * u.occlusion;
          sum += rule.weights[i] * f * sky(wi) * mu;
        }
      }
    });
  });
  return sum * 2 * pi / azimuths;
}

std::vector<ModelScene> model_scenes() {
  std::vector<ModelScene> scenes = {
      {models("beckmann", "smith-correlated", "schlick", "oren-nayar"),
       {.diffuse = 0.8f, .f0 = 0.04f, .roughness = 0.5f},
       30},
      {models("phong", "v-cavity", "schlick", "burley"),
       {.diffuse = 0.4f, .f0 = 0.3f, .roughness = 0.55f},
       45},
      {models("ggx", "smith-correlated", "conductor", "eon"),
       {.diffuse = 0.0f, .f0 = 0.7f, .roughness = 0.4f},
       60},
      {models("beckmann", "smith-separable", "dielectric", "oren-nayar"),
       {.diffuse = 0.6f, .f0 = 0.05f, .roughness = 0.6f, .occlusion = 0.7f},
       20},
      {models("gtr", "smith-correlated", "f82-tint", "fujii"),
       {.diffuse = 0.0f, .f0 = 0.8f, .roughness = 0.45f},
       50}};
  scenes[2].surface.edge_tint = 0.4;
  scenes[2].surface.energy = "turquin";
  scenes[3].surface.coupling = "albedo-scaling";
  scenes[3].coupling_error = 3e-3;
  scenes[4].surface.f82 = 0.6;
  scenes[4].surface.energy = "fdez-aguera";
  return scenes;
}

TEST(ReferencePreview, OfAnyModelsMeetsTheIntegralWithinItsStatedError) {
  const Layers latlong = test::make_latlong({1024, 512}, sky);
  for (const ModelScene& scene : model_scenes()) {
    const std::string view = std::to_string(scene.theta_deg) + ",0";
    const Layers image = test::bake_preview(test::uniform_svbrdf(scene.material), latlong,
                                            {{"samples", "2048"}, {"view", view}}, scene.surface)
                             .artifacts.at(0)
                             .image;
    const Vec3<double> wo = test::direction(std::cos(scene.theta_deg * pi / 180), 0);
    const double truth = integrate_models(scene, wo);
    const double error = test::mean(*image.find("stderr.R")) / 16;
    const double found = test::mean(*image.find("R"));
    EXPECT_NEAR(found, truth, 4 * error + scene.coupling_error * truth)
        << surface_words(scene.surface);
    EXPECT_LT(error, 1e-3 * truth);
  }
}

TEST(ReferencePreview, StatesTheErrorItHas) {
  // The spread of independent texels around their mean is the standard error each states.
  const Layers latlong = test::make_latlong({256, 128}, sky);
  test::Uniform material;
  material.size = {64, 64};
  const Layers image = test::preview(test::uniform_svbrdf(material), latlong, {{"samples", "64"}});
  const Plane &value = *image.find("R"), &stated = *image.find("stderr.R");
  const double mean = test::mean(value);
  double spread = 0, errors = 0;
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      spread += square(value.at(x, y) - mean);
      errors += square(stated.at(x, y));
    }
  }
  EXPECT_NEAR(std::sqrt(errors / spread), 1, 0.08);
}

}  // namespace
}  // namespace kiln

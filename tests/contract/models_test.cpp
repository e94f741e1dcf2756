// SPDX-License-Identifier: Apache-2.0
// Every model on the lists, at every number type. A new model is tested by being listed.
#include "kiln/brdf/models.h"

#include <gtest/gtest.h>

#include "kiln/brdf/roughness.h"
#include "kiln/brdf/surface.h"
#include "kiln/table/directional_albedo.h"
#include "support/directions.h"
#include "support/hemisphere_integral.h"

namespace kiln {
namespace {

using test::as;
using test::first_lane;

constexpr double roughnesses[] = {0.01, 0.05, 0.1, 0.3, 0.6, 1.0};

// Float rounds its arguments first: the oracle is evaluated at the rounded direction.
Vec3<double> rounded(const Vec3<double>& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

void expect_close(double value, double oracle, double tolerance) {
  EXPECT_NEAR(value, oracle, tolerance * std::max(std::abs(oracle), 1e-6));
}

TEST(EveryModel, SaysWhatItIsAndWhereItIsFrom) {
  for (const ModelFacts& model : all_models()) {
    EXPECT_FALSE(model.name.empty());
    EXPECT_FALSE(model.summary.empty()) << model.name;
    EXPECT_FALSE(model.source.empty()) << model.name;
  }
}

TEST(EveryDistribution, AgreesAtEveryNumberType) {
  Distributions::for_each([]<template <class> class Model>() {
    for (const double roughness : roughnesses) {
      const double alpha = static_cast<float>(to_alpha(roughness));
      for (const Vec3<double>& exact : test::hemisphere(50)) {
        const Vec3<double> w = rounded(exact);
        const double oracle = Model<double>::isotropic(alpha).D(w);
        const auto narrow = Model<float>::isotropic(static_cast<float>(alpha));
        const auto wide = Model<WideFloat>::isotropic(WideFloat(static_cast<float>(alpha)));
        expect_close(narrow.D(as<float>(w)), oracle, 16 * 6e-8);
        expect_close(first_lane(wide.D(as<WideFloat>(w))), oracle, 16 * 6e-8);
      }
    }
  });
}

TEST(EveryMasking, AgreesAtEveryNumberTypeAndLiesBetweenZeroAndOne) {
  Maskings::for_each([]<template <class> class Masking>() {
    Distributions::for_each([]<template <class> class Model>() {
      for (const Vec3<double>& a : test::hemisphere(20)) {
        for (const Vec3<double>& b : test::hemisphere(15)) {
          const Vec3<double> wo = rounded(a), wi = rounded(b);
          const double oracle = Masking<double>::G2(Model<double>::isotropic(0.25), wo, wi);
          const double narrow =
              Masking<float>::G2(Model<float>::isotropic(0.25f), as<float>(wo), as<float>(wi));
          EXPECT_GE(oracle, 0);
          EXPECT_LE(oracle, 1);
          expect_close(narrow, oracle, 16 * 6e-8);
        }
      }
    });
  });
}

TEST(EveryDiffuse, IsReciprocalAndNeverNegative) {
  Diffuses::for_each([]<template <class> class Model>() {
    for (const double roughness : {0.0, 0.4, 1.0}) {
      const Model<double> model{{0.2, 0.5, 0.9}, roughness};
      for (const Vec3<double>& wo : test::hemisphere(20)) {
        for (const Vec3<double>& wi : test::hemisphere(17)) {
          const double there = model.eval(wo, wi).y, back = model.eval(wi, wo).y;
          EXPECT_GE(there, 0) << Model<double>::name;
          EXPECT_NEAR(there, back, 1e-12 * there) << Model<double>::name;
        }
      }
    }
  });
}

TEST(EveryDiffuse, ReflectsItsStatedAlbedoAndNeverMoreThanAllLight) {
  Diffuses::for_each([]<template <class> class Model>() {
    for (const double roughness : {0.0, 0.5, 1.0}) {
      for (const double mu : {0.05, 0.5, 1.0}) {
        const Model<double> model{{0.3, 0.8, 1.0}, roughness};
        const Vec3<double> wo = test::direction(mu, 1);
        const double integral = test::integrate_hemisphere(
            [&](const Vec3<double>& wi) { return model.eval(wo, wi).y * wi.z; }, 200, 400);
        EXPECT_NEAR(integral, model.albedo(mu).y, 5e-4) << Model<double>::name;
        EXPECT_LE(model.albedo(mu).z, 1 + 1e-12) << Model<double>::name;
      }
    }
  });
}

TEST(EveryDiffuse, AgreesAtEveryNumberType) {
  Diffuses::for_each([]<template <class> class Model>() {
    for (const Vec3<double>& a : test::hemisphere(20)) {
      const Vec3<double> wo = rounded(a), wi = rounded(test::direction(0.6, 2));
      const Model<double> oracle{{0.25, 0.5, 0.75}, 0.5};
      const Model<float> narrow{{0.25f, 0.5f, 0.75f}, 0.5f};
      const Model<WideFloat> wide{{WideFloat(0.25f), WideFloat(0.5f), WideFloat(0.75f)},
                                  WideFloat(0.5f)};
      const double truth = oracle.eval(wo, wi).y;
      expect_close(narrow.eval(as<float>(wo), as<float>(wi)).y, truth, 2e-6);
      expect_close(first_lane(wide.eval(as<WideFloat>(wo), as<WideFloat>(wi)).y), truth, 2e-6);
    }
  });
}

// Split-sum terms for directions and their average, by quadrature.
SplitSumTerms<double> terms_at(double mu, double alpha) { return integrate_split_sum(mu, alpha); }

template <class Diffuse>
Surface<double, Diffuse> make_surface(double alpha, double f0, double color, double roughness) {
  const Schlick<double> fresnel{{f0, f0, f0}, 1};
  return Surface<double, Diffuse>::make(alpha, fresnel, {{color, color, color}, roughness},
                                        integrate_average(alpha), Energy::Multiscatter);
}

template <class Diffuse>
Reflected<double> evaluate(const Surface<double, Diffuse>& surface, double alpha,
                           const Vec3<double>& wo, const Vec3<double>& wi,
                           const SplitSumTerms<double>& average) {
  const Vec3<double> wm = half_vector(wo, wi);
  return surface.eval(wo, wi, wm, surface.ggx.D(wm),
                      {terms_at(wo.z, alpha), terms_at(wi.z, alpha), average});
}

TEST(EverySurface, IsReciprocal) {
  Diffuses::for_each([]<template <class> class Model>() {
    const double alpha = 0.3;
    const auto average = integrate_average(alpha);
    const auto surface = make_surface<Model<double>>(alpha, 0.3, 0.7, 0.5);
    for (const Vec3<double>& wo : test::hemisphere(10)) {
      for (const Vec3<double>& wi : test::hemisphere(9)) {
        const auto there = evaluate(surface, alpha, wo, wi, average);
        const auto back = evaluate(surface, alpha, wi, wo, average);
        EXPECT_NEAR(there.specular.x, back.specular.x, 1e-12 * there.specular.x);
        EXPECT_NEAR(there.diffuse.x, back.diffuse.x, 1e-12 * there.diffuse.x);
      }
    }
  });
}

// What a white surface under a white lobe reflects toward wo: specular in closed form from its
// split-sum terms, diffuse by quadrature over wi.
template <class Diffuse>
double white_albedo(double alpha, double f0, double roughness, double mu) {
  const auto average = integrate_average(alpha);
  const auto surface = make_surface<Diffuse>(alpha, f0, 1, roughness);
  const Vec3<double> wo = test::direction(mu, 0);
  const auto terms_o = terms_at(mu, alpha);
  const Rule rule = gauss_legendre(64);
  const double reach = std::asinh(1 / alpha);
  double diffuse = 0;
  for (size_t i = 0; i < rule.nodes.size(); ++i) {
    const double mu_i = alpha * std::sinh(reach * rule.nodes[i]);  // all scales from alpha to 1
    const double dmu = alpha * std::cosh(reach * rule.nodes[i]) * reach * rule.weights[i];
    const Albedo<double> albedo{terms_o, terms_at(mu_i, alpha), average};
    const double weight = coupling(surface.greatest, albedo, Diffuse::constant_albedo);
    double ring = 0;
    constexpr int azimuths = 64;
    for (int j = 0; j < azimuths; ++j) {
      ring += surface.diffuse.eval(wo, test::direction(mu_i, 2 * pi * (j + 0.5) / azimuths)).x;
    }
    diffuse += ring * (2 * pi / azimuths) * weight * mu_i * dmu;
  }
  return surface.specular_reflectance(terms_o).x + diffuse;
}

// 1e-4 is what the quadrature here errs by where a diffuse lobe has kinks.
TEST(EverySurface, NeverReflectsMoreThanItReceives) {
  Diffuses::for_each([]<template <class> class Model>() {
    for (const double roughness : {0.1, 0.4, 0.7, 1.0}) {
      for (const double f0 : {0.0, 0.04, 0.5, 1.0}) {
        for (const double mu : {0.02, 0.2, 0.6, 1.0}) {
          const double total = white_albedo<Model<double>>(to_alpha(roughness), f0, roughness, mu);
          EXPECT_LE(total, 1 + 1e-4)
              << Model<double>::name << " r " << roughness << " F0 " << f0 << " mu " << mu;
          EXPECT_GE(total, 0.5);
        }
      }
    }
  });
}

TEST(EverySurface, OfConstantDiffuseAlbedoAndWhiteReflectsExactlyWhatItReceives) {
  Diffuses::for_each([]<template <class> class Model>() {
    if (!Model<double>::constant_albedo) return;
    for (const double roughness : {0.2, 0.5, 1.0}) {
      for (const double mu : {0.1, 0.5, 1.0}) {
        EXPECT_NEAR(white_albedo<Model<double>>(to_alpha(roughness), 0.04, roughness, mu), 1, 1e-5);
      }
    }
  });
}

}  // namespace
}  // namespace kiln

// SPDX-License-Identifier: Apache-2.0
// Every surface that can be put together of the listed models keeps its energy and its symmetry.
#include <gtest/gtest.h>

#include "kiln/brdf/models.h"
#include "kiln/brdf/roughness.h"
#include "kiln/brdf/surface.h"
#include "kiln/integrate/gauss_legendre.h"
#include "kiln/table/directional_albedo.h"
#include "support/directions.h"

namespace kiln {
namespace {

// Split-sum terms for directions and their average, by quadrature.
SplitSumTerms<double> terms_at(double mu, double alpha) { return integrate_split_sum(mu, alpha); }

template <class Diffuse>
Surface<double, Diffuse> make_surface(double alpha, double f0, double color, double roughness) {
  const auto fresnel = schlick_of<double>({f0, f0, f0}, 1.0);
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

// A diffuse model that gains energy may gain that much; 1e-4 is what the quadrature here errs by
// where a lobe has kinks.
TEST(EverySurface, NeverReflectsMoreThanItReceives) {
  Diffuses::for_each([]<template <class> class Model>() {
    for (const double roughness : {0.1, 0.4, 0.7, 1.0}) {
      for (const double f0 : {0.0, 0.04, 0.5, 1.0}) {
        for (const double mu : {0.02, 0.2, 0.6, 1.0}) {
          const double total = white_albedo<Model<double>>(to_alpha(roughness), f0, roughness, mu);
          EXPECT_LE(total, Model<double>::greatest_albedo + 1e-4)
              << Model<double>::name << " r " << roughness << " F0 " << f0 << " mu " << mu;
          EXPECT_GE(total, 0.4);
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

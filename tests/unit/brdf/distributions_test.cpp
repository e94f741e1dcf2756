// SPDX-License-Identifier: Apache-2.0
// What is particular to a distribution or a masking: limits, closed forms, relatives.
#include <gtest/gtest.h>

#include "kiln/brdf/models.h"
#include "kiln/brdf/surface.h"
#include "kiln/integrate/gauss_legendre.h"
#include "support/directions.h"

namespace kiln {
namespace {

using test::direction;

template <class A, class B>
void expect_same_density(const A& a, const B& b, double tolerance) {
  for (const Vec3<double>& wm : test::hemisphere(50)) {
    const double density = b.D(wm);
    EXPECT_NEAR(a.D(wm), density, tolerance * density + 1e-30);
  }
}

TEST(GtrDistribution, OfShapeTwoIsGgx) {
  for (const double alpha : {1e-3, 0.2, 0.7, 1.0}) {
    expect_same_density(Gtr<double>{alpha, alpha, 2}, Ggx<double>::isotropic(alpha), 1e-11);
  }
}

TEST(GtrDistribution, OfShapeOneIsTheLimitOfItsNeighbours) {
  // D(mu) = (a^2 - 1) / (pi ln a^2 (1 + (a^2 - 1) mu^2))
  const double a2 = 0.09, mu = 0.8;
  const double berry = (a2 - 1) / (pi * std::log(a2) * (1 + (a2 - 1) * mu * mu));
  for (const double shape : {1.0, 1 + 1e-7, 1 - 1e-7}) {
    EXPECT_NEAR((Gtr<double>{0.3, 0.3, shape}.D(direction(mu, 1))), berry, 1e-6 * berry);
  }
}

TEST(StudentTDistribution, RunsFromGgxToBeckmann) {
  expect_same_density(StudentT<double>{0.2, 0.5, 2}, Ggx<double>{0.2, 0.5}, 1e-12);
  const StudentT<double> late{0.4, 0.4, 1e7};
  for (const double mu : {0.99, 0.9, 0.8}) {
    const double density = Beckmann<double>::isotropic(0.4).D(direction(mu, 0));
    EXPECT_NEAR(late.D(direction(mu, 0)), density, 1e-5 * density);
  }
}

TEST(PhongDistribution, IsThePowerOfTheCosine) {
  const double alpha = 0.3, n = 2 / (alpha * alpha) - 2;
  for (const Vec3<double>& wm : test::hemisphere(30)) {
    const double density = (n + 2) / (2 * pi) * std::pow(wm.z, n);
    EXPECT_NEAR(Phong<double>::isotropic(alpha).D(wm), density, 1e-12 * density + 1e-300);
  }
  EXPECT_NEAR(Phong<double>::isotropic(1).D(direction(0.2, 0)), 1 / pi, 1e-15);
}

TEST(CharlieDistribution, IsThePowerOfTheSine) {
  for (const double a : {0.1, 0.5, 1.0}) {
    const double mu = 0.6, sine = 0.8;
    const double density = (2 + 1 / a) / (2 * pi) * std::pow(sine, 1 / a);
    EXPECT_NEAR(Charlie<double>::isotropic(a).D(direction(mu, 0)), density, 1e-13);
  }
}

// Lambda by its definition, INT_cot^inf (s - cot) P(s) ds / cot, with P the Gaussian of the slopes
// along the view; a = cot / alpha.
double lambda_by_quadrature(double a) {
  const Rule rule = gauss_legendre(100);
  double sum = 0;
  for (size_t i = 0; i < rule.nodes.size(); ++i) {
    const double x = 24 * rule.nodes[i] / (1 + a);  // beyond, nothing is left of exp(-2 a x - x^2)
    sum += rule.weights[i] * x * std::exp(-x * (2 * a + x)) * 24 / (1 + a);
  }
  return sum * std::exp(-a * a) / (a * std::sqrt(pi));
}

TEST(BeckmannDistribution, HasTheLambdaOfItsDefinition) {
  for (const double a : {0.01, 0.3, 1.0, 2.0, 5.0, 9.0, 20.0}) {
    const double alpha = 0.5, cotangent = a * alpha;
    const double mu = cotangent / std::sqrt(1 + cotangent * cotangent);
    const double lambda = Beckmann<double>::isotropic(alpha).lambda(direction(mu, 2));
    const double exact = lambda_by_quadrature(a);
    EXPECT_NEAR(lambda / exact, 1, 1e-11 * (1 + a * a)) << "a " << a;
  }
}

TEST(BeckmannDistribution, HasTheLambdaOfTheErrorFunction) {
  for (double a = 0.01; a < 3; a *= 1.3) {
    const double exact = std::exp(-a * a) / (2 * a * std::sqrt(pi)) - std::erfc(a) / 2;
    EXPECT_NEAR(gaussian_lambda(a), exact, 1e-15 + 4e-15 * exact) << "a " << a;
  }
}

TEST(BeckmannDistribution, IsBoundedStraightDownAndAtTheHorizon) {
  const auto beckmann = Beckmann<float>::isotropic(0.3f);
  EXPECT_EQ(beckmann.lambda({0, 0, 1}), 0);
  EXPECT_TRUE(std::isfinite(beckmann.lambda({1, 0, 0})));
  EXPECT_GT(beckmann.lambda({1, 0, 0}), 1e6f);
}

TEST(VCavityMasking, OfAMirrorIsOpen) {
  const Vec3<double> wo = direction(0.2, 0), wi = direction(0.2, pi);
  EXPECT_NEAR((VCavity<double>::G2(Ggx<double>::isotropic(0.1), wo, wi, {0, 0, 1})), 1, 1e-15);
}

TEST(KelemenMasking, IsAtMostTheSquaredCosineOfTheHalfVector) {
  const auto ggx = Ggx<double>::isotropic(0.3);
  for (const Vec3<double>& wo : test::hemisphere(20)) {
    for (const Vec3<double>& wi : test::hemisphere(17)) {
      const Vec3<double> wm = half_vector(wo, wi);
      EXPECT_LE(Kelemen<double>::G2(ggx, wo, wi, wm), wm.z * wm.z + 1e-14);
    }
  }
}

TEST(SchlickGgxMasking, IsExactForAnAlphaOfOne) {
  const auto ggx = Ggx<double>::isotropic(1);
  const Vec3<double> wo = direction(0.3, 0), wi = direction(0.7, 1), wm = half_vector(wo, wi);
  EXPECT_NEAR(SchlickGgx<double>::G2(ggx, wo, wi, wm), SmithSeparable<double>::G2(ggx, wo, wi, wm),
              1e-14);
}

TEST(HammonMaskingTest, IsExactForAlphasOfZeroAndOneAndTheSameAsUnreals) {
  const Vec3<double> wo = direction(0.3, 0), wi = direction(0.7, 1), wm = half_vector(wo, wi);
  const auto rough = Ggx<double>::isotropic(1), smooth = Ggx<double>::isotropic(1e-9);
  using Smith = SmithCorrelated<double>;
  using Hammon = HammonMasking<double>;
  EXPECT_NEAR(Hammon::G2(rough, wo, wi, wm), Smith::G2(rough, wo, wi, wm), 1e-14);
  EXPECT_NEAR(Hammon::G2(smooth, wo, wi, wm), 1, 1e-8);
  for (const double alpha : {0.1, 0.4, 0.9}) {
    const auto ggx = Ggx<double>::isotropic(alpha);
    EXPECT_NEAR(Hammon::visibility(ggx, wo, wi, wm),
                UnrealJoint<double>::visibility(ggx, wo, wi, wm), 1e-14);
  }
}

TEST(SmithMasking, OfTwoWidthsAlikeIsThatOfOne) {
  const Vec3<double> wo = direction(0.3, 0.4), wi = direction(0.7, 1), wm = half_vector(wo, wi);
  const auto check = [&]<template <class> class Model>() {
    if constexpr (Model<double>::has_lambda) {
      const auto two = Model<double>::make(0.3, 0.3, 2), one = Model<double>::isotropic(0.3);
      using Smith = SmithCorrelated<double>;
      EXPECT_DOUBLE_EQ(Smith::G2(two, wo, wi, wm), Smith::G2(one, wo, wi, wm));
    }
  };
  Distributions::for_each(check);
}

TEST(EstevezKullaMasking, IsSmoothWhereItsTwoHalvesMeet) {
  const double step = 1e-6;
  for (const double alpha : {0.05, 0.5, 1.0}) {
    const auto lambda = [&](double mu) { return EstevezKulla<double>::lambda(alpha, mu); };
    EXPECT_NEAR(lambda(0.5 - 1e-12), lambda(0.5 + 1e-12), 1e-9);
    const double before = (lambda(0.5) - lambda(0.5 - step)) / step;
    const double after = (lambda(0.5 + step) - lambda(0.5)) / step;
    EXPECT_NEAR(before, after, 1e-4 * std::abs(before));
  }
}

}  // namespace
}  // namespace kiln

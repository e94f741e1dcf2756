// SPDX-License-Identifier: Apache-2.0
#include "kiln/brdf/ggx.h"

#include <gtest/gtest.h>

#include "kiln/brdf/roughness.h"
#include "kiln/brdf/smith.h"
#include "kiln/brdf/surface.h"
#include "support/directions.h"
#include "support/hemisphere_integral.h"

namespace kiln {
namespace {

using test::direction;
using Distribution = Ggx<double>;
using Smith = SmithCorrelated<double>;

TEST(GgxDistribution, ProjectedAreaIntegratesToOne) {
  // With t = alpha sinh x every scale of the lobe is equal; 40 alphas over all of the domain.
  const Rule rule = gauss_legendre(64);
  for (int k = 0; k < 40; ++k) {
    const double alpha = std::pow(10.0, -4 + 4 * k / 39.0);
    const double reach = std::asinh(1e9 / alpha);
    double sum = 0;
    for (int panel = 0; panel < 8; ++panel) {
      for (size_t i = 0; i < rule.nodes.size(); ++i) {
        const double x = reach * (panel + rule.nodes[i]) / 8;
        const double t = alpha * std::sinh(x);
        const double dt = alpha * std::cosh(x) * reach / 8 * rule.weights[i];
        sum += 2 * pi * t * Distribution::isotropic(alpha).P22(square(t / alpha)) * dt;
      }
    }
    EXPECT_NEAR(sum, 1, 1e-12) << "alpha " << alpha;
  }
}

TEST(GgxDistribution, SlopeFormAndNormalFormAgree) {
  for (const double alpha : {0.01, 0.3, 1.0}) {
    const auto ggx = Distribution::isotropic(alpha);
    for (const Vec3<double>& wm : test::hemisphere(30)) {
      const double t2 = (1 - wm.z * wm.z) / (wm.z * wm.z);
      EXPECT_NEAR(ggx.D(wm) * std::pow(wm.z, 4) / ggx.P22(t2 / (alpha * alpha)), 1, 1e-10);
    }
  }
}

TEST(GgxDistribution, IsZeroBelowTheSurface) {
  EXPECT_EQ(Distribution::isotropic(0.5).D({0.6, 0, -0.8}), 0);
}

TEST(GgxDistribution, VisibleNormalsSumToTheProjectedArea) {
  // The weak white furnace: INT G1 max(0, o.h) D dh = mu_o.
  for (const double alpha : {0.3, 0.6, 1.0}) {
    for (const double mu : {0.05, 0.3, 0.8, 1.0}) {
      const auto ggx = Distribution::isotropic(alpha);
      const Vec3<double> wo = direction(mu, 0.4);
      const double sum = test::integrate_hemisphere(
          [&](const Vec3<double>& wm) {
            return Smith::G1(ggx, wo, wm) * std::max(0.0, dot(wo, wm)) * ggx.D(wm);
          },
          400, 800);
      EXPECT_NEAR(sum / mu, 1, 2e-4) << "alpha " << alpha << " mu " << mu;
    }
  }
}

TEST(SmithMasking, VisibilityIsG2OverFourCosines) {
  for (const Vec3<double>& wo : test::hemisphere(12)) {
    for (const Vec3<double>& wi : test::hemisphere(11)) {
      const Distribution ggx{0.2, 0.6};
      const double quotient = Smith::G2(ggx, wo, wi, half_vector(wo, wi)) / (4 * wo.z * wi.z);
      EXPECT_NEAR(Smith::visibility(ggx, wo, wi, half_vector(wo, wi)) / quotient, 1, 1e-12);
    }
  }
}

TEST(SmithMasking, OfBothIsNeverMoreThanOfEither) {
  const Distribution ggx{0.2, 0.6};
  for (const Vec3<double>& wo : test::hemisphere(20)) {
    for (const Vec3<double>& wi : test::hemisphere(20)) {
      const Vec3<double> wm = half_vector(wo, wi);
      const double both = Smith::G2(ggx, wo, wi, wm);
      EXPECT_GE(both, 0);
      EXPECT_LE(both, std::min(Smith::G1(ggx, wo, wm), Smith::G1(ggx, wi, wm)) + 1e-15);
    }
  }
}

TEST(SmithMasking, GrowsTowardGrazing) {
  const auto ggx = Distribution::isotropic(0.4);
  double before = 0;
  for (double mu = 1; mu > 0.001; mu -= 0.01) {
    const double lambda = ggx.lambda(direction(mu, 0));
    EXPECT_GE(lambda, before);
    before = lambda;
  }
}

TEST(Roughness, IsSquaredToAlphaAndKeptAwayFromZero) {
  EXPECT_DOUBLE_EQ(to_alpha(0.5), 0.25);
  EXPECT_DOUBLE_EQ(to_alpha(0.0), min_alpha);
  EXPECT_DOUBLE_EQ(to_alpha(-1.0), min_alpha);
  EXPECT_DOUBLE_EQ(to_alpha(2.0), 1.0);
}

}  // namespace
}  // namespace kiln

// SPDX-License-Identifier: Apache-2.0
#include "kiln/table/skin.h"

#include <gtest/gtest.h>

#include <cmath>

#include "kiln/integrate/gauss_legendre.h"

namespace kiln {
namespace {

TEST(SkinProfile, WeightsOfEachColourSumToOne) {
  Vec3<double> sum;
  for (const auto& gaussian : skin_profile) sum += gaussian.weight;
  EXPECT_NEAR(sum.x, 1, 1e-12);
  EXPECT_NEAR(sum.y, 1, 1e-12);
  EXPECT_NEAR(sum.z, 1, 1e-12);
}

TEST(PreintegratedSkin, OfAFlatPatchIsTheCosine) {
  for (const double mu : {-0.5, -0.1, 0.0, 0.2, 0.9}) {
    EXPECT_EQ(integrate_skin(mu, 0).x, std::max(mu, 0.0));
    // A flat enough one differs by the variance of the profile where the cosine is smooth, and by
    // its standard deviation at the terminator.
    EXPECT_NEAR(integrate_skin(mu, 1e-4).x, std::max(mu, 0.0), mu == 0 ? 2e-4 : 1e-7);
  }
}

TEST(PreintegratedSkin, OfATinyBallIsItsMean) {
  // R is constant over the ball: INT max(0, cos) / 2 pi = 1 / pi on every side.
  for (const double mu : {-1.0, -0.3, 0.4, 1.0}) {
    const Vec3<double> d = integrate_skin(mu, 1e4);
    for (const double channel : {d.x, d.y, d.z}) EXPECT_NEAR(channel, 1 / pi, 1e-6);
  }
}

TEST(PreintegratedSkin, MovesLightAboutAndLosesNone) {
  // The mean over the circle of normals is that of max(0, cos).
  const Rule rule = gauss_legendre(40);
  for (const double curvature : {0.05, 0.3, 1.0}) {
    Vec3<double> sum;
    constexpr int panels = 24;
    for (int panel = 0; panel < panels; ++panel) {
      for (size_t i = 0; i < rule.nodes.size(); ++i) {
        const double theta = pi * (panel + rule.nodes[i]) / panels;
        sum += integrate_skin(std::cos(theta), curvature) * (rule.weights[i] / panels);
      }
    }
    EXPECT_NEAR(sum.x, 1 / pi, 1e-8) << curvature;
    EXPECT_NEAR(sum.y, 1 / pi, 1e-8) << curvature;
    EXPECT_NEAR(sum.z, 1 / pi, 1e-8) << curvature;
  }
}

// A midpoint rule over the circle, as the definition stands.
Vec3<double> by_definition(double theta, double curvature) {
  constexpr int n = 400000;
  Vec3<double> lit, all;
  for (int i = 0; i < n; ++i) {
    const double x = 2 * pi * ((i + 0.5) / n - 0.5);
    const double r2 = square(2 * std::sin(x / 2) / curvature);
    Vec3<double> profile;
    for (const auto& g : skin_profile) {
      profile += g.weight * (std::exp(-r2 / (2 * g.variance)) / (2 * pi * g.variance));
    }
    lit += profile * std::max(0.0, std::cos(theta + x));
    all += profile;
  }
  return {lit.x / all.x, lit.y / all.y, lit.z / all.z};
}

TEST(PreintegratedSkin, IsItsDefinition) {
  for (const double curvature : {0.02, 0.5, 3.0}) {
    for (const double theta : {0.0, 1.2, 1.7, 3.0}) {
      const Vec3<double> d = integrate_skin(std::cos(theta), curvature);
      const Vec3<double> expected = by_definition(theta, curvature);
      EXPECT_NEAR(d.x, expected.x, 1e-9) << curvature << " " << theta;
      EXPECT_NEAR(d.y, expected.y, 1e-9) << curvature << " " << theta;
      EXPECT_NEAR(d.z, expected.z, 1e-9) << curvature << " " << theta;
    }
  }
}

TEST(PreintegratedSkin, OfTheOrderGivenHasConverged) {
  for (const double curvature : {1e-3, 0.1, 0.5, 1.0, 5.0}) {
    for (double mu = -1; mu <= 1; mu += 0.125) {
      const Vec3<double> d = integrate_skin(mu, curvature), e = integrate_skin(mu, curvature, 80);
      EXPECT_NEAR(d.x, e.x, 1e-12);
      EXPECT_NEAR(d.y, e.y, 1e-12);
      EXPECT_NEAR(d.z, e.z, 1e-12);
    }
  }
}

TEST(PreintegratedSkin, RedReachesFarthestPastTheTerminator) {
  const Vec3<double> d = integrate_skin(-0.2, 0.2);
  EXPECT_GT(d.x, d.y);
  EXPECT_GT(d.y, d.z);
}

}  // namespace
}  // namespace kiln

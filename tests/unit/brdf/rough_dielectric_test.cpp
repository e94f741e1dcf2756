// SPDX-License-Identifier: Apache-2.0
#include "kiln/brdf/rough_dielectric.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/hemisphere_integral.h"

namespace kiln {
namespace {

using test::direction;
using Glass = RoughDielectric<double>;

std::vector<Vec3<double>> both_sides(int n) {
  std::vector<Vec3<double>> all = test::hemisphere(n);
  for (int i = 0; i < n; ++i) all.push_back({all[i].y, all[i].x, -all[i].z});
  return all;
}

double index_at(const Glass& glass, const Vec3<double>& w) { return w.z > 0 ? 1 : glass.eta; }

// Over both hemispheres.
template <class Integrand>
double integrate_sphere(const Integrand& f) {
  const auto below = [&](const Vec3<double>& w) { return f(Vec3<double>{w.x, w.y, -w.z}); };
  return test::integrate_hemisphere(f, 200, 400) + test::integrate_hemisphere(below, 200, 400);
}

TEST(RoughDielectric, ReflectsAlikeWhenLightRunsBackward) {
  const Glass glass{0.2, 0.5, 1.5};
  for (const auto& wo : both_sides(9)) {
    for (const auto& wi : both_sides(8)) {
      const double there = glass.eval(wo, wi) / square(index_at(glass, wo));
      const double back = glass.eval(wi, wo) / square(index_at(glass, wi));
      EXPECT_NEAR(there, back, 1e-10 * there);
    }
  }
}

TEST(RoughDielectric, CarriesImportanceAsItCarriesRadianceBackward) {
  const Glass glass{0.3, 0.4, 1.33};
  for (const auto& wo : both_sides(9)) {
    for (const auto& wi : both_sides(8)) {
      const double importance = glass.eval(wo, wi, Transport::Importance);
      EXPECT_NEAR(importance, glass.eval(wi, wo, Transport::Radiance), 1e-12 * importance);
    }
  }
}

TEST(RoughDielectric, NeverScattersMoreThanItReceives) {
  for (const double eta : {1.2, 1.5, 2.4}) {
    for (const double alpha : {0.3, 0.6, 1.0}) {
      for (const double mu : {0.1, 0.5, 0.95, -0.2, -0.6, -0.95}) {
        const Glass glass{alpha, alpha, eta};
        const Vec3<double> wo = direction(mu, 0.4);
        const double energy = integrate_sphere([&](const Vec3<double>& wi) {
          return glass.eval(wo, wi, Transport::Importance) * std::abs(wi.z);
        });
        EXPECT_LE(energy, 1 + 1e-3);
        EXPECT_GE(energy, 0.3);
      }
    }
  }
}

// The mean over a fine grid of uniform numbers.
template <class Quantity>
double mean_of_samples(const Glass& glass, const Vec3<double>& wo, const Quantity& quantity) {
  constexpr int n = 256, choices = 64;
  double sum = 0;
  for (int i = 0; i < n * n; ++i) {
    const int row = i / n;
    const double x = (i % n + 0.5) / n, y = (row + 0.5) / n;
    // Every column of the grid takes another choice of side; 37 is prime to 64.
    const double z = ((i * 37 + row * 11) % choices + 0.5) / choices;
    sum += quantity(glass.sample(wo, {x, y, z}, Transport::Importance));
  }
  return sum / (n * n);
}

TEST(RoughDielectric, SamplesAreWorthTheEnergyThatItScatters) {
  for (const double mu : {0.9, 0.3, -0.8, -0.4}) {
    const Glass glass{0.4, 0.7, 1.5};
    const Vec3<double> wo = direction(mu, 1.1);
    const double energy = integrate_sphere([&](const Vec3<double>& wi) {
      return glass.eval(wo, wi, Transport::Importance) * std::abs(wi.z);
    });
    EXPECT_NEAR(mean_of_samples(glass, wo, [](const auto& s) { return s.weight; }), energy, 4e-3);
  }
}

TEST(RoughDielectric, DensityIntegratesToOneWithoutTheRejectedDraws) {
  for (const double mu : {0.9, 0.3, -0.8, -0.4}) {
    const Glass glass{0.4, 0.7, 1.5};
    const Vec3<double> wo = direction(mu, 1.1);
    const double mass =
        integrate_sphere([&](const Vec3<double>& wi) { return glass.density(wo, wi); });
    const auto kept = [](const auto& s) { return s.density > 0 ? 1.0 : 0.0; };
    EXPECT_NEAR(mass, mean_of_samples(glass, wo, kept), 4e-3) << mu;
    EXPECT_LE(mass, 1 + 1e-3);
  }
}

TEST(RoughDielectric, SamplesStateTheirDensityAndWeight) {
  const Glass glass{0.2, 0.3, 1.5};
  for (const auto& wo : both_sides(7)) {
    for (int i = 0; i < 64; ++i) {
      const int row = i / 4 % 4, layer = i / 16;
      const Vec3<double> u{(i % 4 + 0.5) / 4, (row + 0.5) / 4, (layer + 0.5) / 4};
      const auto drawn = glass.sample(wo, u);
      if (drawn.density == 0) continue;
      EXPECT_NEAR(glass.density(wo, drawn.wi) / drawn.density, 1, 1e-8);
      const double worth = glass.eval(wo, drawn.wi) * std::abs(drawn.wi.z) / drawn.density;
      EXPECT_NEAR(worth / drawn.weight, 1, 1e-8);
      EXPECT_EQ(drawn.transmitted, drawn.wi.z * wo.z < 0);
    }
  }
}

TEST(RoughDielectric, WithoutAStepOfIndexLetsLightStraightOn) {
  for (const double eta : {1.0, 1.0001}) {
    const Glass glass{0.01, 0.01, eta};
    for (const double mu : {0.3, 0.8, -0.7}) {
      const Vec3<double> wo = direction(mu, 0.2);
      double worst = 0;
      const double energy = mean_of_samples(glass, wo, [&](const auto& s) {
        worst = std::max(worst, length(s.wi + wo));
        return s.transmitted ? s.weight : 0;
      });
      EXPECT_NEAR(energy, 1, 1e-3);
      EXPECT_LE(worst, eta == 1 ? 1e-12 : 0.3);
    }
  }
  EXPECT_EQ((Glass{0.5, 0.5, 1}.eval({0, 0, 1}, {0, 0, -1})), 0);
}

TEST(RoughDielectric, AtAnAlphaNearZeroIsAPlaneBoundary) {
  const Glass glass{1e-4, 1e-4, 1.5};
  const Vec3<double> wo = direction(0.6, 0);
  const auto through = glass.sample(wo, {0.3, 0.4, 0.99});
  EXPECT_TRUE(through.transmitted);
  EXPECT_NEAR(through.wi.x, -wo.x / 1.5, 1e-3);
  const auto back = glass.sample(wo, {0.3, 0.4, 0.01});
  EXPECT_FALSE(back.transmitted);
  EXPECT_NEAR(back.wi.x, -wo.x, 1e-3);
  const double reflected =
      mean_of_samples(glass, wo, [](const auto& s) { return s.transmitted ? 0 : s.weight; });
  EXPECT_NEAR(reflected, Dielectric<double>{1.5}.eval(0.6), 2e-3 + 1.0 / 64);
}

template <class F>
RoughDielectric<F> as_glass(double alpha_x, double alpha_y, double eta) {
  using S = ScalarOf<F>;
  return {F(static_cast<S>(alpha_x)), F(static_cast<S>(alpha_y)), F(static_cast<S>(eta))};
}

template <class F>
void expect_like_double(double tolerance) {
  const Glass oracle{0.2, 0.5, 1.5};
  const auto glass = as_glass<F>(0.2, 0.5, 1.5);
  for (const auto& wo : both_sides(7)) {
    for (const auto& wi : both_sides(8)) {
      const double f = oracle.eval(wo, wi), p = oracle.density(wo, wi);
      const double tested = test::first_lane(glass.eval(test::as<F>(wo), test::as<F>(wi)));
      EXPECT_NEAR(tested, f, tolerance * f);
      const double density = test::first_lane(glass.density(test::as<F>(wo), test::as<F>(wi)));
      EXPECT_NEAR(density, p, tolerance * p);
    }
    const auto drawn = oracle.sample(wo, {0.3, 0.7, 0.4});
    const auto like = glass.sample(test::as<F>(wo), test::as<F>({0.3, 0.7, 0.4}));
    EXPECT_NEAR(test::first_lane(like.wi.x), drawn.wi.x, 2e-6);
    EXPECT_NEAR(test::first_lane(like.weight), drawn.weight, 2e-5);
  }
}

TEST(RoughDielectric, IsTheSameInFloatAndWide) {
  expect_like_double<float>(4e-5);
  expect_like_double<WideFloat>(4e-5);
}

TEST(RoughDielectric, TakesEveryDirection) {
  const Vec3<float> odd[] = {{1, 0, 0}, {0, 0, 1}, {0, 0, -1}, {0.8f, 0, -0.6f}, {-1, 0, 0}};
  for (const float eta : {0.4f, 1.0f, 1.5f}) {
    for (const float alpha : {1e-4f, 1.0f}) {
      const RoughDielectric<float> glass{alpha, alpha, eta};
      for (const auto& wo : odd) {
        for (const auto& wi : odd) {
          EXPECT_GE(glass.eval(wo, wi), 0);
          EXPECT_GE(glass.density(wo, wi), 0);
        }
        for (const float z : {0.001f, 0.5f, 0.999f}) {
          const auto drawn = glass.sample(wo, {0.999f, 0.999f, z});
          EXPECT_GE(drawn.weight, 0);
          EXPECT_GE(drawn.density, 0);
        }
      }
    }
  }
}

}  // namespace
}  // namespace kiln

// SPDX-License-Identifier: Apache-2.0
// Samples fall as their densities say: chi-squared over (cosine, azimuth) cells, 10^6 samples a
// case, seeds 0..n-1, family-wise significance 0.01.
#include <gtest/gtest.h>

#include <functional>
#include <random>

#include "kiln/brdf/surface.h"
#include "kiln/integrate/gauss_legendre.h"
#include "support/chi_squared.h"
#include "support/directions.h"

namespace kiln {
namespace {

constexpr int samples = 1000000;
constexpr int cosines = 101, azimuths = 202;  // odd, so that no cell edge lies on an axis

using Sampler = std::function<Vec3<double>(const Vec2<double>&)>;
using Density = std::function<double(const Vec3<double>&)>;

std::vector<double> count_cells(const Sampler& sample, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<double> counts(cosines * azimuths + 1);
  for (int i = 0; i < samples; ++i) {
    const double x = uniform(random), y = uniform(random);
    const Vec3<double> w = sample({x, y});
    if (w.z <= 0) {
      counts.back() += 1;  // rejected below the horizon
      continue;
    }
    const double phi = std::atan2(w.y, w.x) / (2 * pi) + 0.5;
    const int row = std::min(static_cast<int>(w.z * cosines), cosines - 1);
    const int column = std::min(static_cast<int>(phi * azimuths), azimuths - 1);
    counts[row * azimuths + column] += 1;
  }
  return counts;
}

double cell_mass(const Density& density, int row, int column, const Rule& rule) {
  double mass = 0;
  for (size_t i = 0; i < rule.nodes.size(); ++i) {
    for (size_t j = 0; j < rule.nodes.size(); ++j) {
      const double mu = (row + rule.nodes[i]) / cosines;
      const double phi = 2 * pi * ((column + rule.nodes[j]) / azimuths - 0.5);
      mass += rule.weights[i] * rule.weights[j] * density(test::direction(mu, phi));
    }
  }
  return mass * 2 * pi / (cosines * azimuths);
}

// The last cell holds the share that the density leaves below the horizon.
std::vector<double> expect_cells(const Density& density) {
  const Rule rule = gauss_legendre(8);
  std::vector<double> expected(cosines * azimuths + 1);
  double total = 0;
  for (int row = 0; row < cosines; ++row) {
    for (int column = 0; column < azimuths; ++column) {
      const double mass = cell_mass(density, row, column, rule);
      expected[row * azimuths + column] = mass * samples;
      total += mass;
    }
  }
  EXPECT_LE(total, 1 + 1e-3);
  expected.back() = std::max(0.0, 1 - total) * samples;
  return expected;
}

struct Lobe {
  double alpha_x, alpha_y, mu;
};

constexpr Lobe lobes[] = {{0.3, 0.3, 1.0}, {0.3, 0.3, 0.7}, {0.5, 0.5, 0.3},
                          {0.9, 0.9, 0.5}, {1.0, 1.0, 0.1}, {0.2, 0.6, 0.6}};
constexpr int cases = 7;

TEST(BoundedVisibleNormals, FallAsTheirDensitySays) {
  std::uint64_t seed = 0;
  for (const Lobe& lobe : lobes) {
    const Ggx<double> ggx{lobe.alpha_x, lobe.alpha_y};
    const Vec3<double> wo = test::direction(lobe.mu, 0.7);
    const Sampler sample = [&](const Vec2<double>& u) {
      const Vec3<double> wm = ggx.sample_visible(wo, u);
      return wm * (2 * dot(wo, wm)) - wo;
    };
    const Density density = [&](const Vec3<double>& wi) {
      return ggx.visible_density(wo, ggx.D(half_vector(wo, wi)));
    };
    const auto result = test::chi_squared(count_cells(sample, seed++), expect_cells(density));
    EXPECT_GT(result.cells, 50);
    EXPECT_GT(result.p, test::family_significance(cases))
        << "alpha " << lobe.alpha_x << " " << lobe.alpha_y << " mu " << lobe.mu;
  }
}

TEST(CosineDirections, FallAsTheirDensitySays) {
  const auto result = test::chi_squared(
      count_cells([](const Vec2<double>& u) { return square_to_cosine(u); }, cases - 1),
      expect_cells([](const Vec3<double>& w) { return cosine_density(w); }));
  EXPECT_GT(result.p, test::family_significance(cases));
}

TEST(BoundedVisibleNormals, RejectFewReflections) {
  // At alpha 0.9 and mu 0.5 the unbounded cap rejects 30 %, the bounded one 1.7 %.
  const auto ggx = Ggx<double>::isotropic(0.9);
  const Vec3<double> wo = test::direction(0.5, 0);
  const auto counts = count_cells(
      [&](const Vec2<double>& u) {
        const Vec3<double> wm = ggx.sample_visible(wo, u);
        return wm * (2 * dot(wo, wm)) - wo;
      },
      0);
  EXPECT_NEAR(counts.back() / samples, 0.017, 0.002);
}

TEST(ChiSquaredTest, RejectsASamplerThatIsSlightlyOff) {
  const auto result =
      test::chi_squared(count_cells(
                            [](const Vec2<double>& u) {
                              return square_to_cosine(Vec2<double>{u.x, u.y * 0.99});
                            },
                            0),
                        expect_cells([](const Vec3<double>& w) { return cosine_density(w); }));
  EXPECT_LT(result.p, 1e-6);
}

}  // namespace
}  // namespace kiln

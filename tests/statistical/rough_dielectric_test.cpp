// SPDX-License-Identifier: Apache-2.0
// Samples of the rough dielectric fall as its density says: chi-squared over (cosine, azimuth)
// cells of the whole sphere, 10^6 samples a case, seeds 0..n-1, family-wise significance 0.01.
#include "kiln/brdf/rough_dielectric.h"

#include <gtest/gtest.h>

#include <random>

#include "kiln/integrate/gauss_legendre.h"
#include "support/chi_squared.h"
#include "support/directions.h"

namespace kiln {
namespace {

constexpr int samples = 1000000;
constexpr int cosines = 102, azimuths = 101;  // the surface lies between two rows of cells

using Glass = RoughDielectric<double>;

struct Case {
  double alpha_x, alpha_y, eta, mu;
  int points = 12;  // of the quadrature of a cell, each way; a density with an edge wants more
};

constexpr Case cases[] = {{0.3, 0.3, 1.5, 0.8},  {0.3, 0.3, 1.5, -0.8},    {0.5, 0.5, 1.5, -0.4},
                          {1.0, 1.0, 2.0, 0.2},  {0.8, 0.8, 1.1, 0.5, 64}, {0.2, 0.6, 1.33, 0.6},
                          {0.6, 0.3, 1.33, -0.5}};

// The last cell counts rejected draws.
std::vector<double> count_cells(const Glass& glass, const Vec3<double>& wo, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<double> counts(cosines * azimuths + 1);
  for (int i = 0; i < samples; ++i) {
    const double x = uniform(random), y = uniform(random), z = uniform(random);
    const auto drawn = glass.sample(wo, {x, y, z});
    if (drawn.density == 0) {
      counts.back() += 1;
      continue;
    }
    const double phi = std::atan2(drawn.wi.y, drawn.wi.x) / (2 * pi) + 0.5;
    const int row = std::min(static_cast<int>((drawn.wi.z + 1) / 2 * cosines), cosines - 1);
    const int column = std::min(static_cast<int>(phi * azimuths), azimuths - 1);
    counts[row * azimuths + column] += 1;
  }
  return counts;
}

double cell_mass(const Glass& glass, const Vec3<double>& wo, int row, int column,
                 const Rule& rule) {
  double mass = 0;
  for (size_t i = 0; i < rule.nodes.size(); ++i) {
    const double mu = 2 * (row + rule.nodes[i]) / cosines - 1;
    for (size_t j = 0; j < rule.nodes.size(); ++j) {
      const double phi = 2 * pi * ((column + rule.nodes[j]) / azimuths - 0.5);
      mass += rule.weights[i] * rule.weights[j] * glass.density(wo, test::direction(mu, phi));
    }
  }
  return mass * 4 * pi / (cosines * azimuths);
}

std::vector<double> expect_cells(const Glass& glass, const Vec3<double>& wo, int points) {
  const Rule rule = gauss_legendre(points);
  std::vector<double> expected(cosines * azimuths + 1);
  double total = 0;
  for (int row = 0; row < cosines; ++row) {
    for (int column = 0; column < azimuths; ++column) {
      const double mass = cell_mass(glass, wo, row, column, rule);
      expected[row * azimuths + column] = mass * samples;
      total += mass;
    }
  }
  EXPECT_LE(total, 1 + 1e-4);
  expected.back() = std::max(0.0, 1 - total) * samples;
  return expected;
}

TEST(RoughDielectricSamples, FallAsTheirDensitySaysOnBothSides) {
  std::uint64_t seed = 0;
  for (const Case& c : cases) {
    const Glass glass{c.alpha_x, c.alpha_y, c.eta};
    const Vec3<double> wo = test::direction(c.mu, 0.7);
    const auto result =
        test::chi_squared(count_cells(glass, wo, seed++), expect_cells(glass, wo, c.points));
    EXPECT_GT(result.cells, 50);
    EXPECT_GT(result.p, test::family_significance(std::size(cases)))
        << "alpha " << c.alpha_x << " " << c.alpha_y << " eta " << c.eta << " mu " << c.mu;
  }
}

}  // namespace
}  // namespace kiln

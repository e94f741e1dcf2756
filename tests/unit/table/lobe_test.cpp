// SPDX-License-Identifier: Apache-2.0
#include "kiln/table/lobe.h"

#include <gtest/gtest.h>

#include <cmath>

#include "kiln/core/error.h"

namespace kiln {
namespace {

// Published to 14 digits by a rule of its own.
TEST(LobeIntegrals, OfAnisotropicLobesDependOnTheAzimuth) {
  const LobeIntegrals lobe({}, {}, Quality::Table);
  EXPECT_NEAR(lobe.at({0.4, 0.1, 0.6, 0.8}).total(), 0.77229906700918, 1e-9);
  EXPECT_NEAR(lobe.at({0.4, 0.1, 0.6, 0}).total(), 0.73627123725276, 1e-9);
  EXPECT_NEAR(lobe.at({0.4, 0.1, 0.6, pi / 2}).total(), 0.79441271444, 1e-9);
  EXPECT_NEAR(lobe.at({0.7, 0.02, 0.3, 1}).total(), 0.90807364911069, 1e-9);
  EXPECT_NEAR(lobe.at({0.5, 0.5, 0.5, 0.3}).total(), 0.69825069692755, 1e-9);
}

TEST(LobeIntegrals, OfZeroWidthAreAMirrorBehindItsMasking) {
  const LobeTerms smith = LobeIntegrals({}, {}, Quality::Table).at({0.3, 0, 0, 0});
  EXPECT_NEAR(smith.total(), 1, 1e-6);
  EXPECT_NEAR(smith.bias, std::pow(0.7, 5), 1e-6);
  const Lobe implicit{"phong", "implicit", 0};
  EXPECT_NEAR(LobeIntegrals(implicit, {}, Quality::Table).at({0.3, 0, 0, 0}).total(), 0.09, 1e-6);
}

TEST(LobeIntegrals, ThirdTermOfAMirrorIsHoffmans) {
  const LobeTerms terms = LobeIntegrals({}, {}, Quality::Table).at({1.0 / 7, 0, 0, 0});
  EXPECT_NEAR(terms.edge, 1.0 / 7 * std::pow(6.0 / 7, 6), 1e-9);
}

std::vector<double> spread(double low, double high, int count) {
  std::vector<double> values;
  for (int i = 0; i < count; ++i) values.push_back(low + (high - low) * i / (count - 1));
  return values;
}

TEST(LobeIntegrals, InterpolateLargeGridsWithoutLosingTheirAccuracy) {
  const std::vector<double> mus = spread(1e-3, 1, 80), alphas = spread(1e-4, 1, 80);
  for (const char* masking : {"smith-correlated", "smith-separable", "schlick-ggx"}) {
    LobeIntegrals quick({"ggx", masking, 0}, {}, Quality::Table, 1e-3);
    const LobeIntegrals exact({"ggx", masking, 0}, {}, Quality::Check);
    const auto grid = quick.grid(mus, alphas);
    for (size_t j = 0; j < alphas.size(); j += 13) {
      for (size_t i = 0; i < mus.size(); i += 7) {
        const LobeTerms truth = exact.at({mus[i], alphas[j], alphas[j], 0});
        const LobeTerms& found = grid[j * mus.size() + i];
        EXPECT_NEAR(found.scale / truth.scale, 1, 5e-7) << mus[i] << " " << alphas[j];
        EXPECT_NEAR(found.bias, truth.bias, 5e-7) << mus[i] << " " << alphas[j];
      }
    }
  }
}

TEST(LobeIntegrals, RefuseMaskingsThatDoNotFit) {
  EXPECT_THROW(LobeIntegrals({"ggx", "estevez-kulla", 0}, {}, Quality::Table), Error);
  EXPECT_THROW(LobeIntegrals({"ggxx", "smith-correlated", 0}, {}, Quality::Table), Error);
  EXPECT_THROW(LobeIntegrals({"ggx", "smith-correlated", 2}, {}, Quality::Table), Error);
  EXPECT_THROW(LobeIntegrals({}, {"shlick", {}}, Quality::Table), Error);
}

}  // namespace
}  // namespace kiln

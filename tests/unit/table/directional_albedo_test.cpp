// SPDX-License-Identifier: Apache-2.0
#include "kiln/table/directional_albedo.h"

#include <gtest/gtest.h>

#include <cmath>

#include "kiln/brdf/roughness.h"
#include "kiln/integrate/gauss_legendre.h"
#include "kiln/table/albedo_table.h"
#include "support/real_data.h"
#include "support/reference_values.h"

namespace kiln {
namespace {

using Terms = SplitSumTerms<double>;

double quantity_of(const Terms& terms, const std::string& name) {
  if (name == "E" || name == "E_avg") return terms.total();
  return name == "A" ? terms.scale : terms.bias;
}

TEST(DirectionalAlbedo, AtAlphaOneIsItsClosedForm) {
  // E = 1 - mu ln(1 + 1/mu) for the height-correlated form.
  for (const double mu : {1e-3, 0.01, 0.1, 0.5, 0.9, 1.0}) {
    const double closed = 1 - mu * std::log1p(1 / mu);
    EXPECT_NEAR(integrate_split_sum(mu, 1, Quality::Exact).total(), closed, 1e-12) << mu;
    EXPECT_NEAR(integrate_split_sum(mu, 1).total(), closed, 1e-6) << mu;
  }
}

TEST(DirectionalAlbedo, StraightDownIsItsOneDimensionalIntegral) {
  // E = INT_0^1 a^2 / (a^2 + w)^2 * 2 (1 - w) / ((1 - w) + sqrt((1 - w)^2 + 4 a^2 w)) dw
  const Rule rule = gauss_legendre(64);
  for (const double alpha : {0.05, 0.3, 0.8}) {
    double sum = 0;
    const double reach = std::log1p(1 / (alpha * alpha));  // w = a^2 (e^x - 1)
    for (size_t i = 0; i < rule.nodes.size(); ++i) {
      const double w = alpha * alpha * std::expm1(reach * rule.nodes[i]);
      const double dw = (w + alpha * alpha) * reach * rule.weights[i];
      const double left = 1 - w;
      sum += square(alpha / (alpha * alpha + w)) * 2 * left /
             (left + std::sqrt(left * left + 4 * alpha * alpha * w)) * dw;
    }
    EXPECT_NEAR(integrate_split_sum(1, alpha, Quality::Exact).total(), sum, 1e-11) << alpha;
  }
}

TEST(DirectionalAlbedo, BiasStraightDownAtAlphaOneIsItsClosedForm) {
  EXPECT_NEAR(integrate_split_sum(1, 1, Quality::Exact).bias, 3.36142947255185e-5, 1e-15);
}

TEST(DirectionalAlbedo, AverageAtAlphaOneIsItsClosedForm) {
  EXPECT_NEAR(integrate_average(1).total(), 4 * (1 - std::log(2.0)) / 3, 1e-9);
}

TEST(DirectionalAlbedo, OfAMirrorIsOne) {
  for (const double mu : {0.1, 0.4, 1.0}) {
    EXPECT_NEAR(integrate_split_sum(mu, to_alpha(0.01)).total(), 1, 1e-4);
  }
}

TEST(DirectionalAlbedo, MeetsTheReferenceValues) {
  KILN_REQUIRE_REAL_DATA(folder);
  int checked = 0;
  for (const auto& v : test::read_reference_values(folder / "reference/reference_values.csv")) {
    if (v.model != "ggx_smith_heightcorr") continue;
    const double alpha = std::stod(v.alpha);
    if (v.mu.empty() || v.quantity.ends_with("avg")) {
      EXPECT_NEAR(quantity_of(integrate_average(alpha), v.quantity), v.value, 2e-8) << v.alpha;
    } else {
      const double mu = std::stod(v.mu);
      const Terms high = integrate_split_sum(mu, alpha, Quality::Exact);
      EXPECT_NEAR(quantity_of(integrate_split_sum(mu, alpha), v.quantity), v.value, 1e-6);
      EXPECT_NEAR(quantity_of(high, v.quantity), v.value, 1e-10);
    }
    ++checked;
  }
  EXPECT_EQ(checked, 208);
}

TEST(AlbedoTable, LooksUpToItsStatedAccuracy) {
  const AlbedoTable table = AlbedoTable::build();
  double inner = 0, all = 0, squares = 0;
  int count = 0;
  for (int i = 0; i < 48; ++i) {
    for (int j = 0; j < 48; ++j) {
      const double mu = square((i + 0.5) / 48), r = (j + 0.37) / 48;
      const double truth = integrate_split_sum(mu, to_alpha(r)).total();
      const auto row = table.row(static_cast<float>(r));
      const double error = std::abs(table.terms(row, static_cast<float>(mu)).total() - truth);
      all = std::max(all, error);
      if (mu >= 0.02 && r >= 0.1) inner = std::max(inner, error);
      squares += error * error;
      ++count;
    }
  }
  EXPECT_LE(inner, 4e-4);
  EXPECT_LE(all, 1.5e-2);
  EXPECT_LE(std::sqrt(squares / count), 4e-4);
}

TEST(AlbedoTable, AveragesToItsStatedAccuracy) {
  const AlbedoTable table = AlbedoTable::build();
  for (double r = 0.03; r < 1; r += 0.0313) {
    const double truth = integrate_average(to_alpha(r)).total();
    EXPECT_NEAR(table.average(table.row(static_cast<float>(r))).total(), truth, 4e-4) << r;
  }
}

TEST(AlbedoTable, ReadsTheSameWideAndScalar) {
  const AlbedoTable table = AlbedoTable::build();
  for (const float r : {0.0f, 0.2f, 0.71f, 1.0f}) {
    const auto wide = table.terms(table.row(WideFloat(r)), WideFloat(0.3f));
    EXPECT_EQ(wide.scale.get(2), table.terms(table.row(r), 0.3f).scale);
  }
}

TEST(AlbedoTable, TakesAnyNumber) {
  const AlbedoTable table = AlbedoTable::build();
  for (const float odd : {-1.0f, 2.0f, NAN, INFINITY}) {
    const float total = table.terms(table.row(odd), 0.5f).total();
    EXPECT_GE(total, 0);
    EXPECT_LE(total, 1.001f);
  }
}

}  // namespace
}  // namespace kiln

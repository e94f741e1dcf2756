// SPDX-License-Identifier: Apache-2.0
#include "kiln/table/lobe.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "kiln/brdf/roughness.h"
#include "kiln/core/error.h"
#include "support/real_data.h"
#include "support/reference_values.h"

namespace kiln {
namespace {

struct ReferenceLobe {
  Lobe lobe;
  FresnelChoice fresnel = {};
};

// The families of the reference values, by the names of models.
std::map<std::string, ReferenceLobe> reference_lobes() {
  FresnelChoice dielectric{"dielectric", {}}, conductor{"conductor", {}};
  dielectric.parameters.ior = 1.5;
  conductor.parameters.ior = 0.2;
  conductor.parameters.extinction = 3.9;
  return {{"ggx_smith_heightcorr", {{"ggx", "smith-correlated"}}},
          {"ggx_smith_separable", {{"ggx", "smith-separable"}}},
          {"beckmann_smith_heightcorr", {{"beckmann", "smith-correlated"}}},
          {"beckmann_smith_separable", {{"beckmann", "smith-separable"}}},
          {"phong_implicit", {{"phong", "implicit"}}},
          {"phong_kelemen", {{"phong", "kelemen"}}},
          {"ggx_schlick_k_half_alpha", {{"ggx", "schlick-ggx"}}},
          {"ggx_hammon", {{"ggx", "hammon"}}},
          {"charlie_neubelt_alpha_r2", {{"charlie", "neubelt"}}},
          {"charlie_neubelt_alpha_r", {{"charlie", "neubelt"}}},
          {"charlie_estevezkulla_alpha_r", {{"charlie", "estevez-kulla"}}},
          {"ggx_smith_heightcorr_dielectric_n1.5", {{"ggx", "smith-correlated"}, dielectric}},
          {"ggx_smith_heightcorr_conductor_n0.2_k3.9", {{"ggx", "smith-correlated"}, conductor}}};
}

double quantity_of(const LobeTerms& terms, const std::string& quantity) {
  if (quantity == "A") return terms.scale;
  return quantity.starts_with("B") ? terms.bias : terms.total();
}

// E and A relative, B absolute.
double error_of(const LobeTerms& terms, const test::ReferenceValue& wanted) {
  const double error = std::abs(quantity_of(terms, wanted.quantity) - wanted.value);
  return wanted.quantity.starts_with("B") ? error : error / std::abs(wanted.value);
}

LobeTerms integrate(const ReferenceLobe& lobe, const test::ReferenceValue& at, Quality quality) {
  const LobeIntegrals integrals(lobe.lobe, lobe.fresnel, quality);
  const double alpha = std::stod(at.alpha);
  if (at.mu.empty() || at.quantity.ends_with("avg")) return integrals.average(alpha);
  return integrals.at({std::stod(at.mu), alpha, alpha, 0});
}

TEST(LobeIntegrals, MeetTheReferenceValuesOfEveryFamily) {
  KILN_REQUIRE_REAL_DATA(folder);
  const auto lobes = reference_lobes();
  int checked = 0;
  for (const auto& wanted :
       test::read_reference_values(folder / "reference/reference_values.csv")) {
    const auto found = lobes.find(wanted.model);
    if (found == lobes.end()) continue;
    const double error = error_of(integrate(found->second, wanted, Quality::Table), wanted);
    EXPECT_LE(error, 1e-6) << wanted.model << " mu " << wanted.mu << " alpha " << wanted.alpha
                           << " " << wanted.quantity;
    ++checked;
  }
  EXPECT_GT(checked, 1700);
}

// Estevez and Kulla's fit has a bend in its second derivative, Kelemen's masking a pole beside the
// horizon, and averages are as good as the tables: those stay at 1e-6.
TEST(LobeIntegrals, MeetTheReferenceValuesToTenDigitsWhenExact) {
  KILN_REQUIRE_REAL_DATA(folder);
  const auto lobes = reference_lobes();
  for (const auto& wanted :
       test::read_reference_values(folder / "reference/reference_values.csv")) {
    const auto found = lobes.find(wanted.model);
    if (found == lobes.end() || wanted.quantity.ends_with("avg")) continue;
    const bool bent = wanted.model == "charlie_estevezkulla_alpha_r" ||
                      wanted.model == "phong_kelemen" || wanted.model.starts_with("charlie");
    const double error = error_of(integrate(found->second, wanted, Quality::Exact), wanted);
    EXPECT_LE(error, bent ? 2e-7 : 1e-10) << wanted.model << " mu " << wanted.mu << " alpha "
                                          << wanted.alpha << " " << wanted.quantity;
  }
}

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

// SPDX-License-Identifier: Apache-2.0
// Integrals of lobes against the reference values of thirteen families.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "kiln/table/lobe.h"
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

}  // namespace
}  // namespace kiln

// SPDX-License-Identifier: Apache-2.0
#include "kiln/table/glass_albedo.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "kiln/brdf/rough_dielectric.h"
#include "kiln/brdf/roughness.h"
#include "support/hemisphere_integral.h"
#include "support/real_data.h"
#include "support/reference_values.h"

namespace kiln {
namespace {

constexpr double indices[] = {1.02, 1.5, 2.4, 1 / 1.02, 1 / 1.5, 1 / 2.4};

TEST(GlassAlbedo, OfAlphaOneWithoutAStepOfIndexIsItsClosedForm) {
  // G2 / G1 = (1 + Lambda) / (1 + 2 Lambda) with Lambda = (1 / mu - 1) / 2.
  for (const double mu : {1e-3, 0.1, 0.5, 1.0}) {
    const GlassTerms terms = integrate_glass(mu, 1, 1);
    EXPECT_NEAR(terms.transmitted, (1 + mu) / 2, 1e-6);
    EXPECT_EQ(terms.reflected, 0);
  }
}

TEST(GlassAlbedo, OfAnAlphaNearZeroIsThatOfAPlaneBoundary) {
  for (const double eta : indices) {
    for (const double mu : {0.3, 0.8, 1.0}) {
      const GlassTerms terms = integrate_glass(mu, 1e-6, eta);
      EXPECT_NEAR(terms.reflected, Dielectric<double>{eta}.eval(mu), 2e-5) << mu << " " << eta;
      EXPECT_NEAR(terms.total(), 1, 2e-5);
    }
  }
}

TEST(GlassAlbedo, OfReflectionAloneIsTheDirectionalAlbedo) {
  // An index that is nothing but total reflection: all but a sliver of facets see F = 1.
  for (const double mu : {0.05, 0.4, 0.8}) {
    for (const double alpha : {0.05, 0.5}) {
      const double mirror = integrate_split_sum(mu, alpha).total();
      const GlassTerms glass = integrate_glass(mu, alpha, 1e-3, glass_reference_order);
      EXPECT_NEAR(glass.reflected, mirror, 1e-5);
    }
  }
}

TEST(GlassAlbedo, TotalsNoMoreThanOne) {
  for (const double eta : indices) {
    for (const double alpha : {1e-4, 0.01, 0.2, 1.0}) {
      for (const double mu : {1e-3, 0.1, 0.6, 0.75, 1.0}) {
        const GlassTerms terms = integrate_glass(mu, alpha, eta);
        EXPECT_LE(terms.total(), 1 + 1e-6);
        EXPECT_GE(terms.reflected, 0);
        EXPECT_GE(terms.transmitted, 0);
        EXPECT_GE(terms.strayed, 0);
        EXPECT_LE(terms.strayed, eta > 1 ? 0 : 1);
      }
    }
  }
}

TEST(GlassAlbedo, AtTheOrderForTablesErrsByLessThanOneMillionth) {
  for (const double eta : {1.02, 1.5, 2.4, 1 / 1.02, 1 / 1.5, 0.1}) {
    for (const double alpha : {1e-4, 0.01, 0.2, 1.0}) {
      for (const double mu : {1e-3, 0.1, 0.6, 0.745, 1.0}) {
        const GlassTerms terms = integrate_glass(mu, alpha, eta);
        const GlassTerms exact = integrate_glass(mu, alpha, eta, glass_reference_order);
        EXPECT_NEAR(terms.reflected, exact.reflected, 1e-6);
        EXPECT_NEAR(terms.transmitted, exact.transmitted, 1e-6);
        EXPECT_NEAR(terms.strayed, exact.strayed, 1e-6);
      }
    }
  }
}

TEST(GlassAlbedo, IsTheIntegralOfTheBsdfOverBothSides) {
  for (const double eta : {1.5, 2.4, 1 / 1.5}) {
    for (const double mu : {0.2, 0.9}) {
      const RoughDielectric<double> glass{0.8, 0.8, eta};
      const Vec3<double> wo = test::direction(mu, 0);
      double shares[2];
      for (const double side : {1.0, -1.0}) {
        shares[side < 0] = test::integrate_hemisphere(
            [&](const Vec3<double>& w) {
              const Vec3<double> wi{w.x, w.y, side * w.z};
              return glass.eval(wo, wi, Transport::Importance) * w.z;
            },
            300, 600);
      }
      const GlassTerms terms = integrate_glass(mu, 0.8, eta);
      EXPECT_NEAR(terms.reflected, shares[0], 1e-4) << eta << " " << mu;
      EXPECT_NEAR(terms.transmitted, shares[1], 2e-3) << eta << " " << mu;
    }
  }
}

TEST(GlassAlbedo, AverageOfLeavingIsThatOfEnteringOverTheSquaredIndex) {
  // Reciprocity of the BTDF, integrated over both directions.
  for (const double eta : {1.1, 1.5, 2.4}) {
    for (const double alpha : {0.01, 0.3, 1.0}) {
      const GlassTerms in = integrate_glass_average(alpha, eta);
      const GlassTerms out = integrate_glass_average(alpha, 1 / eta);
      EXPECT_NEAR(in.transmitted, eta * eta * out.transmitted, 2e-7) << eta << " " << alpha;
    }
  }
}

TEST(GlassAlbedo, ReflectsTheReferenceValues) {
  KILN_REQUIRE_REAL_DATA(folder);
  int checked = 0;
  for (const auto& v : test::read_reference_values(folder / "reference/reference_values.csv")) {
    if (v.model != "ggx_smith_heightcorr_dielectric_n1.5") continue;
    const double alpha = std::stod(v.alpha);
    const bool average = v.quantity == "R_avg";
    const GlassTerms terms = average ? integrate_glass_average(alpha, 1.5)
                                     : integrate_glass(std::stod(v.mu), alpha, 1.5);
    EXPECT_NEAR(terms.reflected, v.value, 1e-6) << v.mu << " " << v.alpha;
    if (!average) {
      const auto high = integrate_glass(std::stod(v.mu), alpha, 1.5, glass_reference_order);
      EXPECT_NEAR(high.reflected, v.value, 1e-10) << v.mu << " " << v.alpha;
    }
    ++checked;
  }
  EXPECT_EQ(checked, 72);
}

std::vector<double> read_numbers(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::string line;
  std::vector<double> numbers;
  while (std::getline(file, line)) {
    if (!line.empty() && line[0] != '#') numbers.push_back(std::stod(line));
  }
  return numbers;
}

// Cycles: [z][mu][roughness], nodes on the borders, F0 = z^4; indices, cosines and roughnesses of 0
// are 1e-4 and the last index is 0.99. Its walk keeps rays that refraction turns back.
struct CyclesEntry {
  double eta, mu, alpha;
};
CyclesEntry cycles_entry(int z, int m, int r, bool leaving) {
  const double root = square(std::clamp(z / 15.0, 1e-4, 0.99));
  const double eta = (1 + root) / (1 - root);
  return {leaving ? 1 / eta : eta, std::max(m / 15.0, 1e-4), square(std::max(r / 15.0, 1e-4))};
}

TEST(GlassAlbedo, MeetsTheTablesOfCyclesWithinTheirNoise) {
  KILN_REQUIRE_REAL_DATA(folder);
  for (const bool leaving : {false, true}) {
    const std::string name = leaving ? "ggx_glass_inv" : "ggx_glass";
    const auto directional =
        read_numbers(folder / ("data/reference/cycles_table_" + name + "_E.txt"));
    const auto average =
        read_numbers(folder / ("data/reference/cycles_table_" + name + "_Eavg.txt"));
    ASSERT_EQ(directional.size(), 4096);
    ASSERT_EQ(average.size(), 256);
    double squares = 0;
    for (int i = 256; i < 4096; i += 3) {  // without z = 0, where Cycles takes eta = 1 as clear
      const auto [eta, mu, alpha] = cycles_entry(i / 256, i / 16 % 16, i % 16, leaving);
      const GlassTerms terms = integrate_glass(mu, alpha, eta);
      const double error = terms.total() + terms.strayed - directional[i];
      EXPECT_NEAR(error, 0, 2e-5) << name << " " << i;
      squares += error * error;
    }
    EXPECT_LE(std::sqrt(squares / 1280), 4e-6);
    for (int i = 16; i < 256; i += 11) {
      const auto [eta, mu, alpha] = cycles_entry(i / 16, 0, i % 16, leaving);
      const GlassTerms terms = integrate_glass_average(alpha, eta);
      EXPECT_NEAR(terms.total() + terms.strayed, average[i], 8e-6) << name << " average " << i;
    }
  }
}

TEST(GlassAlbedo, TakesAnyNumber) {
  for (const double mu : {0.0, -1.0, 2.0}) {
    for (const double alpha : {0.0, 5.0}) {
      for (const double eta : {1e-3, 1.0, 1e3}) {
        const double total = integrate_glass(mu, alpha, eta).total();
        EXPECT_GE(total, 0);
        EXPECT_LE(total, 1 + 1e-5);
      }
    }
  }
}

}  // namespace
}  // namespace kiln

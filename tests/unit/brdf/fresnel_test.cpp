// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <map>

#include "kiln/brdf/conductor.h"
#include "kiln/brdf/dielectric.h"
#include "kiln/brdf/f82.h"
#include "kiln/brdf/gulbrandsen.h"
#include "kiln/brdf/lazanyi.h"
#include "kiln/brdf/schlick.h"
#include "support/real_data.h"
#include "support/reference_values.h"

namespace kiln {
namespace {

TEST(DielectricFresnel, AtNormalIncidenceIsTheSquaredContrast) {
  for (const double n : {0.5, 1.1, 1.33, 1.5, 2.42}) {
    EXPECT_NEAR(Dielectric<double>{n}.eval(1), square((n - 1) / (n + 1)), 1e-15);
    EXPECT_NEAR(Dielectric<double>{n}.eval(0), 1, 1e-12);
  }
}

TEST(DielectricFresnel, AtBrewstersAngleReflectsHalfOfTheSenkrechtLight) {
  // tan of Brewster's angle is n; there only s-polarised light is left, Rs = ((n^2-1)/(n^2+1))^2.
  for (const double n : {0.7, 1.33, 1.5, 2.0}) {
    const double cosine = 1 / std::sqrt(1 + n * n);
    const double senkrecht = square((n * n - 1) / (n * n + 1));
    EXPECT_NEAR(Dielectric<double>{n}.eval(cosine), 0.5 * senkrecht, 1e-13);
  }
}

TEST(DielectricFresnel, FromInsideReflectsAllBeyondTheCriticalAngle) {
  const Dielectric<double> inside{1 / 1.5};
  const double critical = std::sqrt(1 - 1 / 2.25);
  EXPECT_EQ(inside.eval(critical - 1e-6), 1);
  EXPECT_LT(inside.eval(critical + 1e-3), 0.9);
}

TEST(DielectricFresnel, IsTheSameFromBothSidesOfARefractedRay) {
  for (const double c : {0.1, 0.5, 0.9}) {
    const double below = std::sqrt(1 - (1 - c * c) / 2.25);
    EXPECT_NEAR(Dielectric<double>{1.5}.eval(c), Dielectric<double>{1 / 1.5}.eval(below), 1e-14);
  }
}

TEST(DielectricFresnel, WithoutContrastReflectsNothing) {
  EXPECT_EQ(Dielectric<double>{1}.eval(0.5), 0);
  EXPECT_NEAR(Dielectric<double>{1}.average(), 0, 1e-15);
}

TEST(DielectricFresnel, HasTheAveragesOfTheReferenceValues) {
  KILN_REQUIRE_REAL_DATA(folder);
  int checked = 0;
  const std::string prefix = "fresnel_dielectric_n";
  for (const auto& v : test::read_reference_values(folder / "reference/reference_values.csv")) {
    if (v.model.rfind(prefix, 0) != 0) continue;
    const double n = std::stod(v.model.substr(prefix.size()));
    const bool inside = v.quantity == "F_avg_internal";
    EXPECT_NEAR(Dielectric<double>{inside ? 1 / n : n}.average(), v.value, 1e-13) << v.model;
    ++checked;
  }
  EXPECT_EQ(checked, 14);
}

TEST(SchlickFresnel, HasTheAveragesOfTheReferenceValues) {
  KILN_REQUIRE_REAL_DATA(folder);
  int checked = 0;
  const std::string prefix = "fresnel_schlick_F0_";
  for (const auto& v : test::read_reference_values(folder / "reference/reference_values.csv")) {
    if (v.model.rfind(prefix, 0) != 0) continue;
    const double f0 = std::stod(v.model.substr(prefix.size()));
    EXPECT_NEAR((Schlick<double>{f0, 1}.average()), v.value, 1e-15);
    ++checked;
  }
  EXPECT_EQ(checked, 5);
}

TEST(ConductorFresnel, WithoutExtinctionIsADielectric) {
  for (const double n : {0.6, 1.2, 1.5, 2.5}) {
    for (double c = 0.01; c <= 1; c += 0.03) {
      EXPECT_NEAR((Conductor<double>{n, 0}.eval(c)), Dielectric<double>{n}.eval(c), 1e-13) << n;
    }
  }
}

TEST(ConductorFresnel, AtNormalIncidenceIsTheComplexContrast) {
  const double n = 0.2, k = 3.9;
  const double f0 = (square(n - 1) + k * k) / (square(n + 1) + k * k);
  EXPECT_NEAR((Conductor<double>{n, k}.eval(1)), f0, 1e-15);
  EXPECT_NEAR((Conductor<double>{n, k}.eval(0)), 1, 1e-14);
}

TEST(F82TintFresnel, HasTheTintOfSchlickAt82Degrees) {
  for (const double tint : {0.3, 0.8, 1.0}) {
    const auto model = F82Tint<double>::make({.f0 = 0.7, .f82 = tint});
    EXPECT_NEAR(model.eval(1.0 / 7), tint * Schlick<double>({0.7, 1}).eval(1.0 / 7), 1e-14);
  }
}

TEST(F82TintFresnel, WithoutATintIsSchlick) {
  const auto model = F82Tint<double>::make({.f0 = 0.3});
  for (double c = 0; c <= 1; c += 0.1) {
    EXPECT_NEAR(model.eval(c), (Schlick<double>{0.3, 1}.eval(c)), 1e-15);
  }
}

TEST(HoffmanF82Fresnel, GoesThroughItsThreeReflectances) {
  const auto model = HoffmanF82<double>::make({.f0 = 0.8, .f82 = 0.65});
  EXPECT_NEAR(model.eval(1), 0.8, 1e-15);
  EXPECT_NEAR(model.eval(1.0 / 7), 0.65, 1e-14);
  EXPECT_NEAR(model.eval(0), 1, 1e-15);
  // a = 17.6513846 (F0 - F82) + 8.1666667 (1 - F0), and the average falls by a / 126.
  const double a = 17.6513846 * (0.8 - 0.65) + 8.1666667 * (1 - 0.8);
  EXPECT_NEAR(model.dip, a, 1e-6);
  EXPECT_NEAR(model.average(), 0.8 + 0.2 / 21 - a / 126, 1e-8);
}

TEST(GulbrandsenFresnel, HasTheReflectanceThatItWasMadeFrom) {
  for (const double f0 : {0.05, 0.5, 0.95}) {
    for (const double tint : {0.0, 0.4, 1.0}) {
      const auto model = Gulbrandsen<double>::make({.f0 = f0, .edge_tint = tint});
      EXPECT_NEAR(model.eval(1), f0, 1e-12) << f0 << " " << tint;
    }
  }
}

TEST(GulbrandsenFresnel, GivesBackTheEdgeTint) {
  // n between its bounds tells the tint.
  const double f0 = 0.6, root = std::sqrt(f0);
  const double greatest = (1 + root) / (1 - root), least = (1 - f0) / (1 + f0);
  for (const double tint : {0.0, 0.3, 1.0}) {
    const auto model = Gulbrandsen<double>::make({.f0 = f0, .edge_tint = tint});
    EXPECT_NEAR((greatest - model.metal.ior) / (greatest - least), tint, 1e-12);
  }
}

TEST(LazanyiFresnel, WithoutItsErrorTermIsSchlickOfNAndK) {
  const auto model = Lazanyi<double>::make({.ior = 0.4, .extinction = 3});
  const double f0 = (square(0.4 - 1) + 9) / (square(0.4 + 1) + 9);
  for (double c = 0; c <= 1; c += 0.1) {
    EXPECT_NEAR(model.eval(c), (Schlick<double>{f0, 1}.eval(c)), 1e-14);
  }
}

TEST(LazanyiFresnel, AveragesToItsClosedForm) {
  const auto model = Lazanyi<double>::make({.ior = 0.4, .extinction = 3, .dip = 0.7});
  const double f0 = (square(0.4 - 1) + 9) / (square(0.4 + 1) + 9);
  EXPECT_NEAR(model.average(), f0 + (1 - f0) / 21 - 4 * 0.7 / (7 * 8 * 9), 1e-13);
}

}  // namespace
}  // namespace kiln

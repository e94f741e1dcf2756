// SPDX-License-Identifier: Apache-2.0
#include "kiln/table/ltc.h"

#include <gtest/gtest.h>

#include <cmath>

#include "kiln/brdf/roughness.h"
#include "kiln/io/image_file.h"
#include "kiln/parallel/threads.h"
#include "support/hemisphere_integral.h"
#include "support/real_data.h"

namespace kiln {
namespace {

constexpr LtcCell tilted{0.85, -0.1, 0.36, 0.32, 0};

// M from M^-1 = [[m11, 0, m13], [0, 1, 0], [m31, 0, m33]].
Vec3<double> transform(const LtcCell& cell, const Vec3<double>& w) {
  const double d = cell.determinant();
  return {(cell.m33 * w.x - cell.m13 * w.z) / d, w.y, (cell.m11 * w.z - cell.m31 * w.x) / d};
}

TEST(LinearlyTransformedCosine, IsTheCosineCarriedByTheMatrix) {
  // D(M u / |M u|) = u.z / pi |M u|^3 det(M^-1)
  for (const Vec3<double>& u : test::hemisphere(40)) {
    const Vec3<double> carried = transform(tilted, u);
    const double size = length(carried);
    const double density = u.z / pi * size * size * size * tilted.determinant();
    EXPECT_NEAR(ltc_density(tilted, carried * (1 / size)), density, 1e-12 * density);
  }
}

TEST(LinearlyTransformedCosine, IntegratesToOneOverAllDirections) {
  for (const LtcCell& cell : {LtcCell{}, tilted, LtcCell{0.3, -0.05, 0.5, 0.1, 0}}) {
    const auto density = [&](const Vec3<double>& w) { return ltc_density(cell, w); };
    const auto below = [&](const Vec3<double>& w) { return ltc_density(cell, {w.x, w.y, -w.z}); };
    const double sum =
        test::integrate_hemisphere(density, 400, 400) + test::integrate_hemisphere(below, 400, 400);
    EXPECT_NEAR(sum, 1, 1e-4);
  }
}

TEST(LtcFit, FindsALobeThatIsACosineExactly) {
  const LtcLobe cosine = [](double, const Vec3<double>&, const Vec3<double>& wi) {
    return wi.z / pi;
  };
  for (const double mu : {0.2, 0.7, 1.0}) {
    const LtcCell cell = fit_ltc_cell(mu, 1, cosine, LtcCell{});
    EXPECT_NEAR(cell.m11, 1, 1e-4);
    EXPECT_NEAR(cell.m13, 0, 1e-4);
    EXPECT_NEAR(cell.m31, 0, 1e-4);
    EXPECT_NEAR(cell.m33, 1, 1e-4);
    EXPECT_LE(cell.error, 1e-4);
  }
}

TEST(LtcFit, FindsALobeThatIsATransformedCosineExactly) {
  const LtcCell wanted{0.75, -0.05, 0.55, 0.2, 0};
  const LtcLobe lobe = [&](double, const Vec3<double>&, const Vec3<double>& wi) {
    return 0.3 * ltc_density(wanted, wi);
  };
  const LtcCell cell = fit_ltc_cell(0.8, 0.3, lobe, LtcCell{1, 0, 0.3, 0.4, 0});
  // A little of it is below the horizon, where a lobe has to be 0.
  EXPECT_NEAR(cell.m11, wanted.m11, 0.01);
  EXPECT_NEAR(cell.m13, wanted.m13, 0.01);
  EXPECT_NEAR(cell.m31, wanted.m31, 0.01);
  EXPECT_NEAR(cell.m33, wanted.m33, 0.01);
}

TEST(LtcFit, StraightDownIsRoundAboutTheNormal) {
  for (const double alpha : {1e-4, 0.05, 0.5, 1.0}) {
    const LtcCell cell = fit_ltc_cell(1, alpha, ggx_ltc_lobe(), LtcCell{});
    EXPECT_EQ(cell.m11, 1);
    EXPECT_EQ(cell.m13, 0);
    EXPECT_EQ(cell.m31, 0);
    EXPECT_LE(cell.error, 0.03);
  }
}

TEST(LtcFit, OfANarrowLobeTendsToTheMirror) {
  // M^-1 turns the mirrored direction up, and the lobe is mu times as wide across the plane of
  // view as in it.
  const double mu = 0.8;
  const LtcCell cell = fit_ltc_cell(mu, 1e-3, ggx_ltc_lobe(), LtcCell{});
  EXPECT_NEAR(cell.m11, mu * mu, 1e-3);
  EXPECT_NEAR(cell.m13, mu * 0.6, 1e-3);
  EXPECT_LE(cell.error, 0.01);
}

TEST(LtcFit, ErrsAsItSays) {
  const LtcCell cell = fit_ltc_cell(0.5, 0.25, ggx_ltc_lobe(), LtcCell{});
  EXPECT_NEAR(cell.error, measure_ltc(cell, 0.5, 0.25, ggx_ltc_lobe()).l1, 1e-3);
}

TEST(LtcTable, HasTheSameBitsForAnyNumberOfThreads) {
  const auto many = fit_ltc({6, 5});
  const ThreadLimit one(1);
  const auto single = fit_ltc({6, 5});
  ASSERT_EQ(many.size(), 30);
  for (size_t i = 0; i < many.size(); ++i) {
    EXPECT_EQ(many[i].m11, single[i].m11);
    EXPECT_EQ(many[i].m33, single[i].m33);
    EXPECT_EQ(many[i].error, single[i].error);
  }
}

TEST(LtcTable, HoldsNumbersThatAreSound) {
  for (const LtcCell& cell : fit_ltc({9, 9})) {
    EXPECT_GT(cell.determinant(), 0);
    EXPECT_GT(cell.m33, 0);
    EXPECT_LE(std::abs(cell.m11) + std::abs(cell.m13) + std::abs(cell.m31), 3);
    EXPECT_LE(cell.error, 0.5);
  }
}

float texel(const ImageFile& file, const std::string& channel, int x, int y) {
  return file.image.find(channel)->at(x, y);
}

TEST(LtcTable, FitsNoWorseThanThePublishedOne) {
  KILN_REQUIRE_REAL_DATA(folder);
  const ImageFile file = read_image(folder / "data/reference/three_ltc_mat_1_64.exr");
  const LtcLobe lobe = ggx_ltc_lobe();
  double ours = 0, theirs = 0;
  for (int row = 0; row < 63; row += 9) {
    LtcCell start;
    for (int column = 63; column > 0; column -= 9) {
      const double mu = ltc_cosine(row, 64), alpha = to_alpha(column / 63.0);
      const auto at = [&](const char* name) { return texel(file, name, column, row); };
      const LtcCell published{at("R"), at("G"), at("B"), at("A"), 0};
      start = fit_ltc_cell(mu, alpha, lobe, start);
      const LtcErrors fitted = measure_ltc(start, mu, alpha, lobe);
      const LtcErrors known = measure_ltc(published, mu, alpha, lobe);
      EXPECT_LE(fitted.l3, known.l3 * 1.001) << column << " " << row;
      EXPECT_LE(std::abs(start.m11 - published.m11), 0.06) << column << " " << row;
      EXPECT_LE(std::abs(start.m13 - published.m13), 0.25) << column << " " << row;
      ours += fitted.l1;
      theirs += known.l1;
    }
  }
  EXPECT_LE(ours, 0.85 * theirs);
}

TEST(SphereFormFactor, OfAWholeCapIsTheCosineOfItsMiddle) {
  EXPECT_NEAR(sphere_form_factor(0.8, 0.3), 0.8, 1e-15);
  EXPECT_EQ(sphere_form_factor(-0.8, 0.3), 0);
  EXPECT_NEAR(sphere_form_factor(0.4, 0), 0.4, 1e-15);
  EXPECT_NEAR(sphere_form_factor(1, 1), 1, 1e-15);
}

TEST(SphereFormFactor, IsTheClippedIntegralOverTheCap) {
  const Rule rule = gauss_legendre(200);
  for (const double z : {-0.5, -0.1, 0.0, 0.2, 0.6}) {
    for (const double sine2 : {0.1, 0.6, 0.95}) {
      const double cap = 1 - std::sqrt(1 - sine2), sine = std::sqrt(1 - z * z);
      double sum = 0;
      for (size_t i = 0; i < rule.nodes.size(); ++i) {
        const double c = 1 - cap * rule.nodes[i], s = std::sqrt(1 - c * c);
        for (int j = 0; j < 2000; ++j) {
          const double phi = 2 * pi * (j + 0.5) / 2000;
          sum += rule.weights[i] * cap * 2 * pi / 2000 *
                 std::max(0.0, z * c + sine * s * std::cos(phi));
        }
      }
      EXPECT_NEAR(sphere_form_factor(z, sine2), sum / (pi * sine2), 2e-5) << z << " " << sine2;
    }
  }
}

TEST(SphereFormFactor, MeetsThePublishedTable) {
  KILN_REQUIRE_REAL_DATA(folder);
  const ImageFile file = read_image(folder / "data/reference/three_ltc_mat_2_64.exr");
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      EXPECT_NEAR(sphere_form_factor(2 * x / 63.0 - 1, y / 63.0), texel(file, "A", x, y), 4e-6);
    }
  }
}

}  // namespace
}  // namespace kiln

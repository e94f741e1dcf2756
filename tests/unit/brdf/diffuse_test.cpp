// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "kiln/brdf/burley.h"
#include "kiln/brdf/eon.h"
#include "kiln/brdf/hammon_diffuse.h"
#include "kiln/brdf/lambert.h"
#include "kiln/brdf/oren_nayar.h"
#include "support/hemisphere_integral.h"
#include "support/real_data.h"
#include "support/reference_values.h"

namespace kiln {
namespace {

Eon<double> eon(double color, double roughness) { return {{color, color, color}, roughness}; }

double integrated_albedo(const Eon<double>& model, double mu) {
  const Vec3<double> wo = test::direction(mu, 0.3);
  return test::integrate_hemisphere(
      [&](const Vec3<double>& wi) { return model.eval(wo, wi).x * wi.z; }, 300, 600);
}

TEST(Eon, AWhiteSurfaceReflectsAllLight) {
  for (const double roughness : {0.0, 0.3, 1.0}) {
    for (const double mu : {1e-3, 0.1, 0.5, 1.0}) {
      EXPECT_NEAR(eon(1, roughness).albedo(mu).x, 1, 1e-12);
    }
  }
}

TEST(Eon, IntegratesToItsClosedFormAlbedo) {
  for (const double roughness : {0.2, 1.0}) {
    for (const double mu : {0.1, 0.5, 0.95}) {
      const Eon<double> model = eon(0.5, roughness);
      EXPECT_NEAR(integrated_albedo(model, mu), model.albedo(mu).x, 2e-4);
    }
  }
}

TEST(Eon, WithoutRoughnessIsLambert) {
  const Vec3<double> wo = test::direction(0.3, 0), wi = test::direction(0.7, 2);
  const Lambert<double> lambert{{0.5, 0.5, 0.5}, 0};
  EXPECT_NEAR(eon(0.5, 0).eval(wo, wi).x, lambert.eval(wo, wi).x, 1e-14);
}

TEST(Eon, MeetsTheReferenceAlbedos) {
  KILN_REQUIRE_REAL_DATA(folder);
  int checked = 0;
  for (const auto& v : test::read_reference_values(folder / "reference/reference_values.csv")) {
    const bool half = v.model == "diffuse_EON_rho0.5", white = v.model == "diffuse_EON_rho1.0";
    if (!(half || white) || v.quantity != "E") continue;
    const double albedo = eon(half ? 0.5 : 1.0, std::stod(v.roughness)).albedo(std::stod(v.mu)).x;
    EXPECT_NEAR(albedo, v.value, 1e-12) << v.mu << " " << v.roughness;
    ++checked;
  }
  EXPECT_EQ(checked, 60);
}

// Checks a model's albedo against the rows of its name that have a direction; returns how many.
template <template <class> class Model>
int check_reference_albedos(const std::filesystem::path& table, const std::string& name) {
  int checked = 0;
  for (const auto& v : test::read_reference_values(table)) {
    if (v.model != name || v.quantity != "E") continue;
    const Model<double> white{{1, 1, 1}, std::stod(v.roughness)};
    EXPECT_NEAR(white.albedo(std::stod(v.mu)).x, v.value, 1e-13) << v.mu << " " << v.roughness;
    ++checked;
  }
  return checked;
}

TEST(Burley, MeetsTheReferenceAlbedos) {
  KILN_REQUIRE_REAL_DATA(folder);
  EXPECT_EQ(
      check_reference_albedos<Burley>(folder / "reference/reference_values.csv", "diffuse_burley"),
      30);
}

TEST(Burley, GainsEnergyAboveARoughnessOfTwoFifths) {
  const auto greatest = [](double roughness) {
    double most = 0;
    for (double mu = 0; mu <= 1; mu += 0.01) {
      most = std::max(most, Burley<double>{{1, 1, 1}, roughness}.albedo(mu).x);
    }
    return most;
  };
  EXPECT_LE(greatest(0.39), 1);
  EXPECT_GT(greatest(0.41), 1);
}

TEST(Fujii, MeetsTheReferenceAlbedosAndAverages) {
  KILN_REQUIRE_REAL_DATA(folder);
  const auto table = folder / "reference/reference_values.csv";
  EXPECT_EQ(check_reference_albedos<Fujii>(table, "diffuse_fujii_FON"), 30);
  for (const auto& v : test::read_reference_values(table)) {
    if (v.model != "diffuse_fujii_FON" || v.quantity != "E_avg") continue;
    EXPECT_NEAR((Fujii<double>{{1, 1, 1}, std::stod(v.roughness)}.white_average()), v.value, 1e-13);
  }
}

TEST(OrenNayar, WithoutRoughnessIsLambert) {
  const Vec3<double> wo = test::direction(0.3, 0), wi = test::direction(0.7, 2);
  EXPECT_NEAR((OrenNayar<double>{{0.5, 0.5, 0.5}, 0}.eval(wo, wi).x), 0.5 / pi, 1e-15);
  EXPECT_NEAR((OrenNayar<double>{{0.5, 0.5, 0.5}, 0}.albedo(0.3).x), 0.5, 1e-15);
}

TEST(OrenNayar, HasTheValueOfItsFormulaInAngles) {
  // The formula as printed, with angles and tangents.
  const double s2 = 0.36, theta_o = 1.1, theta_i = 0.6, rho = 0.7;
  for (const double phi : {0.4, 2.5}) {
    const double a = std::max(theta_o, theta_i), b = std::min(theta_o, theta_i), c = std::cos(phi);
    const double c1 = 1 - 0.5 * s2 / (s2 + 0.33);
    const double c2 =
        0.45 * s2 / (s2 + 0.09) * (c >= 0 ? std::sin(a) : std::sin(a) - std::pow(2 * b / pi, 3));
    const double c3 = 0.125 * s2 / (s2 + 0.09) * square(4 * a * b / (pi * pi));
    const double single =
        c1 + c * c2 * std::tan(b) + (1 - std::abs(c)) * c3 * std::tan((a + b) / 2);
    const double twice = 0.17 * s2 / (s2 + 0.13) * (1 - c * square(2 * b / pi));
    const Vec3<double> wo = test::direction(std::cos(theta_o), 0);
    const Vec3<double> wi = test::direction(std::cos(theta_i), phi);
    EXPECT_NEAR((OrenNayar<double>{{rho, rho, rho}, 0.6}.eval(wo, wi).x),
                (rho * single + rho * rho * twice) / pi, 1e-14);
  }
}

TEST(HammonDiffuseModel, WithoutRoughnessIsItsSmoothPart) {
  const double mu_o = 0.3, mu_i = 0.8;
  const double smooth = 1.05 * (1 - std::pow(1 - mu_o, 5)) * (1 - std::pow(1 - mu_i, 5)) / pi;
  const HammonDiffuse<double> model{{1, 1, 1}, 0};
  EXPECT_NEAR(model.eval(test::direction(mu_o, 0), test::direction(mu_i, 1)).x, smooth, 1e-15);
  EXPECT_NEAR(model.albedo(mu_o).x, 1 - std::pow(1 - mu_o, 5), 1e-15);
}

}  // namespace
}  // namespace kiln

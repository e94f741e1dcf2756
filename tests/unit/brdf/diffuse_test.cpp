// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "kiln/brdf/eon.h"
#include "kiln/brdf/lambert.h"
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

}  // namespace
}  // namespace kiln

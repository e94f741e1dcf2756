// SPDX-License-Identifier: Apache-2.0
#include "kiln/table/diffuse_albedo.h"

#include <gtest/gtest.h>

#include "kiln/brdf/models.h"
#include "support/faults.h"
#include "support/real_data.h"
#include "support/reference_values.h"

namespace kiln {
namespace {

constexpr double cosines[] = {1e-4, 1e-3, 0.05, 0.3, 0.7, 1.0};
constexpr double roughnesses[] = {0.0, 0.2, 0.6, 1.0};

TEST(DiffuseAlbedo, OfEveryModelIsWhatTheModelSays) {
  Diffuses::for_each([&]<template <class> class Model>() {
    using M = Model<double>;
    if constexpr (M::has_albedo) {
      const double tolerance = M::closed_albedo ? 1e-11 : 1e-6;
      for (const double mu : cosines) {
        for (const double roughness : roughnesses) {
          const DiffuseSurface surface{std::string(M::name), roughness, 0.7};
          const double claimed = M{{0.7, 0.7, 0.7}, roughness}.albedo(mu).x;
          EXPECT_NEAR(integrate_diffuse(surface, mu), claimed, tolerance)
              << M::name << " mu " << mu << " roughness " << roughness;
        }
      }
    }
  });
}

TEST(DiffuseAlbedo, OfEveryModelHasConverged) {
  for (const std::string& model : model_names("diffuse")) {
    for (const double mu : cosines) {
      const DiffuseSurface surface{model, 0.8, 1};
      EXPECT_NEAR(integrate_diffuse(surface, mu), integrate_diffuse(surface, mu, 96), 1e-12);
      EXPECT_NEAR(integrate_diffuse(surface, mu, 24), integrate_diffuse(surface, mu, 96), 1e-7);
    }
    EXPECT_NEAR(integrate_diffuse_average({model, 0.8, 1}),
                integrate_diffuse_average({model, 0.8, 1}, 80), 1e-10);
  }
}

TEST(DiffuseAlbedo, OfAWhiteEnergyPreservingSurfaceIsOne) {
  for (const double mu : cosines) EXPECT_NEAR(integrate_diffuse({"eon", 1, 1}, mu), 1, 1e-11);
  EXPECT_NEAR(integrate_diffuse_average({"eon", 0.4, 1}), 1, 1e-11);
}

TEST(DiffuseAlbedo, MeetsTheReferenceValues) {
  KILN_REQUIRE_REAL_DATA(folder);
  int checked = 0;
  for (const auto& v : test::read_reference_values(folder / "reference/reference_values.csv")) {
    DiffuseSurface surface;
    if (v.model == "diffuse_burley") surface.model = "burley";
    if (v.model == "diffuse_fujii_FON") surface.model = "fujii";
    if (v.model == "diffuse_EON_rho0.5") surface.color = 0.5;
    if (!v.model.starts_with("diffuse_") || v.model == "diffuse_lambert") continue;
    surface.roughness = std::stod(v.roughness);
    const double albedo = v.quantity == "E_avg" ? integrate_diffuse_average(surface)
                                                : integrate_diffuse(surface, std::stod(v.mu));
    EXPECT_NEAR(albedo, v.value, 1e-10) << v.model << " " << v.mu << " " << v.roughness;
    ++checked;
  }
  EXPECT_EQ(checked, 130);
}

TEST(DiffuseAlbedo, NamesTheNearestModelForAnUnknownOne) {
  const std::string said = test::fault_text(Fault::Usage, [] {
    integrate_diffuse({"burly", 0.5, 1}, 0.5);
  });
  EXPECT_NE(said.find("'burley'"), std::string::npos) << said;
}

}  // namespace
}  // namespace kiln

// SPDX-License-Identifier: Apache-2.0
#include "kiln/light/chain_plan.h"

#include <gtest/gtest.h>

#include <cmath>

#include "kiln/core/error.h"

namespace kiln {
namespace {

TEST(ChainPlan, RunsFromTheEnvironmentToFullRoughnessForEveryCurve) {
  for (const RoughnessCurve& curve : all_roughness_curves()) {
    for (const int size : {64, 128, 256, 1024}) {
      const ChainPlan plan = plan_chain(curve.name, size);
      ASSERT_EQ(plan.sizes.size(), plan.roughness.size());
      EXPECT_EQ(plan.sizes.front(), size);
      EXPECT_EQ(plan.roughness.front(), 0) << curve.name;
      EXPECT_GE(plan.roughness.back(), curve.name == "playcanvas" ? 0.9 : 1 - 1e-12) << curve.name;
      for (size_t level = 1; level < plan.sizes.size(); ++level) {
        EXPECT_EQ(plan.sizes[level], size >> level);
        EXPECT_GE(plan.roughness[level], plan.roughness[level - 1]) << curve.name;
        EXPECT_LE(plan.roughness[level], 1) << curve.name;
      }
    }
  }
}

TEST(ChainPlan, FollowsTheFormulasOfTheEngines) {
  EXPECT_EQ(plan_chain("linear", 256).roughness, (std::vector<double>{0, 0.25, 0.5, 0.75, 1}));
  EXPECT_NEAR(plan_chain("filament", 256).roughness[1], 1 - std::sqrt(0.75), 1e-15);
  const ChainPlan unity = plan_chain("unity", 256);
  ASSERT_EQ(unity.sizes.size(), 7u);
  for (size_t level = 0; level < 7; ++level) {
    const double r = unity.roughness[level];
    EXPECT_NEAR(r * (1.7 - 0.7 * r), static_cast<double>(level) / 6, 1e-15);
  }
  const ChainPlan babylon = plan_chain("babylon", 256);
  ASSERT_EQ(babylon.sizes.size(), 9u);
  EXPECT_NEAR(std::pow(babylon.roughness[4], 2), std::exp2(5) / 256, 1e-15);
  const ChainPlan materialx = plan_chain("materialx", 256);
  EXPECT_NEAR(materialx.roughness[4], 0.5, 1e-15);
  EXPECT_NEAR(std::pow(materialx.roughness[6], 2), 2 * (0.75 - 0.375), 1e-15);
  EXPECT_NEAR(plan_chain("playcanvas", 128).roughness[1], 1 - std::log2(512) / 11, 1e-15);
}

TEST(ChainPlan, TakesAListOfRoughnesses) {
  const ChainPlan plan = plan_chain("0,0.3,1", 64);
  EXPECT_EQ(plan.roughness, (std::vector<double>{0, 0.3, 1}));
  EXPECT_EQ(plan.sizes, (std::vector<int>{64, 32, 16}));
  EXPECT_THROW(plan_chain("0,0.3,1.2", 64), Error);
  EXPECT_THROW(plan_chain("0,,1", 64), Error);
  EXPECT_THROW(plan_chain("0,0.1,0.2,0.3", 4), Error);
  EXPECT_THROW(plan_chain("filamnet", 64), Error);
}

}  // namespace
}  // namespace kiln

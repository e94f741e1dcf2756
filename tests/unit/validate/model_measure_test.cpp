// SPDX-License-Identifier: Apache-2.0
#include "kiln/validate/model_measure.h"

#include <gtest/gtest.h>

namespace kiln {
namespace {

TEST(ModelMeasures, SmithMaskingPassesTheWeakFurnace) {
  for (const char* distribution : {"ggx", "beckmann"}) {
    for (const char* masking : {"smith-correlated", "smith-separable"}) {
      const LobeMeasure measure = measure_lobe({distribution, masking, 0});
      ASSERT_TRUE(measure.weak_furnace.has_value());
      EXPECT_NEAR(measure.weak_furnace->least, 1, 2e-3) << distribution << " " << masking;
      EXPECT_NEAR(measure.weak_furnace->greatest, 1, 2e-3) << distribution << " " << masking;
      EXPECT_LE(measure.greatest_albedo, 1 + 1e-6);
    }
  }
}

// 0.826 at roughness 0.2 and n.v 0.05 was computed independently.
TEST(ModelMeasures, SchlicksMaskingFailsIt) {
  const LobeMeasure measure = measure_lobe({"ggx", "schlick-ggx", 0});
  ASSERT_TRUE(measure.weak_furnace.has_value());
  EXPECT_LT(measure.weak_furnace->least, 0.827);
}

TEST(ModelMeasures, SomeMaskingHasNoneOfOneDirection) {
  EXPECT_FALSE(measure_lobe({"ggx", "kelemen", 0}).weak_furnace.has_value());
}

// Greatest over alpha >= 0.1 was computed independently: 1.34 at n.v 0.001.
TEST(ModelMeasures, ClothGainsEnergyAtGrazingAngles) {
  EXPECT_GT(measure_lobe({"charlie", "neubelt", 0}).greatest_albedo, 1.3);
}

TEST(ModelMeasures, BurleysDiffuseGainsEnergyAndLambertsDoesNot) {
  const DiffuseMeasure burley = measure_diffuse("burley");
  EXPECT_NEAR(burley.greatest_albedo, 1.5557, 2e-3);  // 1.5575 at n.v 0
  EXPECT_EQ(burley.roughness, 1);
  EXPECT_NEAR(measure_diffuse("lambert").greatest_albedo, 1, 1e-4);
  EXPECT_NEAR(measure_diffuse("eon").greatest_albedo, 1, 1e-4);
}

}  // namespace
}  // namespace kiln

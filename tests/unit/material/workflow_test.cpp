// SPDX-License-Identifier: Apache-2.0
#include "kiln/material/workflow.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "kiln/core/error.h"

namespace kiln {
namespace {

using testing::ElementsAre;

TEST(Workflows, AreParsedByTheirNamesInEitherSpelling) {
  for (size_t i = 0; i < workflow_names.size(); ++i) {
    EXPECT_EQ(parse_workflow(workflow_names[i]), static_cast<Workflow>(i));
  }
  EXPECT_EQ(parse_workflow("metal_rough"), Workflow::MetalRough);
}

TEST(Workflows, NameTheNearestForASlipOfTheHand) {
  try {
    parse_workflow("spec-glos");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::Usage);
    EXPECT_THAT(error.what(), testing::HasSubstr("'spec-gloss'"));
  }
}

TEST(Workflows, AreGuessedFromTheMapsThatAreGiven) {
  EXPECT_EQ(guess_workflow({Slot::BaseColor, Slot::Metallic}).workflow, Workflow::MetalRough);
  EXPECT_EQ(guess_workflow({Slot::BaseColor, Slot::Roughness}).workflow, Workflow::MetalRough);
  EXPECT_EQ(guess_workflow({Slot::Diffuse, Slot::SpecularColor, Slot::Gloss}).workflow,
            Workflow::SpecGloss);
  EXPECT_EQ(guess_workflow({Slot::BaseColor, Slot::SpecularColor, Slot::Roughness}).workflow,
            Workflow::AlbedoSpecularRoughness);
}

TEST(Workflows, ReadGlossForRoughnessAndDiffuseForBaseColour) {
  EXPECT_THAT(slots_read(Workflow::MetalRough, {Slot::Diffuse, Slot::Gloss, Slot::Emissive}),
              ElementsAre(Slot::Diffuse, Slot::Gloss));
  EXPECT_THAT(slots_read(Workflow::SpecGloss, {Slot::BaseColor, Slot::Roughness, Slot::Metallic}),
              ElementsAre(Slot::BaseColor, Slot::Roughness));
}

TEST(Workflows, NeverReadHeightOpacityOrEmissive) {
  for (size_t i = 0; i < workflow_names.size(); ++i) {
    const Slot ignored[] = {Slot::Height, Slot::Opacity, Slot::Emissive};
    EXPECT_TRUE(
        slots_read(static_cast<Workflow>(i), {std::begin(ignored), std::end(ignored)}).empty());
  }
}

TEST(SpecularEncodings, AgreeOnFourPercentForTheirUsualDefaults) {
  EXPECT_NEAR(f0_of(SpecularEncoding::Level, 0.5f), 0.04f, 1e-7);
  EXPECT_NEAR(f0_of(SpecularEncoding::F0, 0.04f), 0.04f, 1e-7);
  EXPECT_NEAR(f0_of(SpecularEncoding::Ior, 1.5f), 0.04f, 1e-7);
  EXPECT_NEAR(f0_of(SpecularEncoding::Reflectance, 0.5f), 0.04f, 1e-7);
}

TEST(SpecularEncodings, StayWithinZeroAndOneForAnyValue) {
  for (size_t i = 0; i < specular_encoding_names.size(); ++i) {
    const auto encoding = static_cast<SpecularEncoding>(i);
    EXPECT_EQ(parse_specular_encoding(specular_encoding_names[i]), encoding);
    for (const float value : {-1.0f, 0.0f, 0.5f, 1.0f, 3.0f, 1e6f}) {
      EXPECT_GE(f0_of(encoding, value), 0.0f);
      EXPECT_LE(f0_of(encoding, value), 1.0f);
    }
  }
}

TEST(WorkflowSettings, AreSetByName) {
  WorkflowSettings settings;
  assign(workflow_params(), settings, "workflow", "spec-gloss");
  assign(workflow_params(), settings, "normal", "dx");
  assign(workflow_params(), settings, "normal-zero", "128");
  EXPECT_EQ(settings.workflow, Workflow::SpecGloss);
  EXPECT_EQ(settings.normal, NormalConvention::DirectX);
  EXPECT_EQ(settings.normal_zero, NormalZero::Code128);
}

}  // namespace
}  // namespace kiln

// SPDX-License-Identifier: Apache-2.0
#include "kiln/bake/pack_layout.h"

#include <gmock/gmock.h>

#include "kiln/core/error.h"

namespace kiln {
namespace {

using testing::HasSubstr;

std::string refusal(const std::string& layout) {
  try {
    parse_layout(layout);
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::Usage);
    return error.what();
  }
  return "accepted";
}

TEST(PackLayout, OfEveryPresetParsesAndNamesEachFileOnce) {
  for (const PackPreset& preset : all_pack_presets()) {
    std::vector<std::string> seen;
    for (const PackedFile& file : parse_layout(preset.layout)) {
      EXPECT_THAT(seen, testing::Not(testing::Contains(file.suffix))) << preset.name;
      EXPECT_FALSE(file.channels.empty()) << preset.name;
      seen.push_back(file.suffix);
    }
  }
}

TEST(PackLayout, SpreadsAColourOverThreeChannelsAndTakesOneByItsLetter) {
  const auto files = parse_layout("a = base_color, opacity; b = normal.g, 1 - metallic, 0.5");
  ASSERT_EQ(files.size(), 2u);
  ASSERT_EQ(files[0].channels.size(), 4u);
  for (int c = 0; c < 3; ++c) {
    EXPECT_EQ(files[0].channels[static_cast<size_t>(c)].slot, Slot::BaseColor);
    EXPECT_EQ(files[0].channels[static_cast<size_t>(c)].channel, c);
  }
  EXPECT_EQ(files[1].channels[0].channel, 1);
  EXPECT_TRUE(files[1].channels[1].inverted);
  EXPECT_TRUE(files[1].channels[2].is_constant);
}

TEST(PackLayout, ReadsSmoothnessAsOneMinusRoughness) {
  const auto files = parse_layout("a = smoothness, 1 - smoothness, gloss");
  EXPECT_EQ(files[0].channels[0].slot, Slot::Roughness);
  EXPECT_TRUE(files[0].channels[0].inverted);
  EXPECT_FALSE(files[0].channels[1].inverted);
  EXPECT_TRUE(files[0].channels[2].inverted);
}

TEST(PackLayout, TakesNormalsInEitherConvention) {
  const auto files = parse_layout("a = normal_dx; b = normal_gl.g, normal.r");
  EXPECT_EQ(files[0].channels[2].slot, Slot::Normal);
  EXPECT_EQ(files[0].channels[2].convention, NormalConvention::DirectX);
  EXPECT_EQ(files[1].channels[0].convention, NormalConvention::OpenGl);
  EXPECT_EQ(files[1].channels[1].convention, NormalConvention::OpenGl);
}

TEST(PackLayout, SaysWhatItDoesNotUnderstand) {
  EXPECT_THAT(refusal("a = metalic"), HasSubstr("did you mean 'metallic'"));
  EXPECT_THAT(refusal("a"), HasSubstr("expected NAME = SOURCE"));
  EXPECT_THAT(refusal("a = 1.5"), HasSubstr("expected [0, 1]"));
  EXPECT_THAT(refusal("a = normal.q"), HasSubstr("expected .r, .g or .b"));
  EXPECT_THAT(refusal("a = base_color, base_color"), HasSubstr("expected at most 4"));
  EXPECT_THAT(refusal(" ; "), HasSubstr("found no file"));
}

}  // namespace
}  // namespace kiln

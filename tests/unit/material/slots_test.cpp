// SPDX-License-Identifier: Apache-2.0
#include "kiln/material/slots.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "kiln/core/error.h"

namespace kiln {
namespace {

TEST(Slots, StandInTheListInTheOrderOfTheEnumeration) {
  for (size_t i = 0; i < slot_list.size(); ++i) {
    EXPECT_EQ(static_cast<size_t>(slot_list[i].slot), i) << slot_list[i].name;
  }
}

TEST(Slots, AllHaveANameAMeaningChannelsAndAConstantWithinRange) {
  for (const SlotFacts& facts : slot_list) {
    EXPECT_FALSE(facts.name.empty());
    EXPECT_FALSE(facts.meaning.empty()) << facts.name;
    EXPECT_TRUE(facts.channels == 1 || facts.channels == 3) << facts.name;
    for (const float value : facts.missing) {
      EXPECT_GE(value, 0.0f) << facts.name;
      EXPECT_LE(value, 1.0f) << facts.name;
    }
    EXPECT_EQ(parse_slot(facts.name), facts.slot);
  }
}

TEST(Slots, AreColoursExactlyWhereTheyHaveThreeChannelsAndAreNoNormals) {
  for (const SlotFacts& facts : slot_list) {
    const bool color = facts.channels == 3 && facts.slot != Slot::Normal;
    EXPECT_EQ(facts.content == Content::Color, color) << facts.name;
  }
}

TEST(Slots, AreFoundByAliasAndInEitherSpelling) {
  EXPECT_EQ(parse_slot("albedo"), Slot::BaseColor);
  EXPECT_EQ(parse_slot("specular"), Slot::SpecularLevel);
  EXPECT_EQ(parse_slot("base-color"), Slot::BaseColor);
  EXPECT_EQ(parse_slot("smoothness"), Slot::Gloss);
}

TEST(Slots, NameTheNearestSlotForASlipOfTheHand) {
  try {
    parse_slot("roughnes");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::Usage);
    EXPECT_THAT(error.what(), testing::HasSubstr("did you mean 'roughness'"));
  }
}

TEST(Channels, ArePickedByNameWhateverTheirOrder) {
  Layers image = make_layers({1, 1}, {"A", "B", "G", "R"});
  for (size_t i = 0; i < 4; ++i) image.layers[i].plane.at(0, 0) = static_cast<float>(i);
  const Layers rgb = pick_channels(image, "rgb");
  ASSERT_EQ(rgb.layers.size(), 3u);
  EXPECT_EQ(rgb.layers[0].plane.at(0, 0), 3);
  EXPECT_EQ(rgb.layers[2].plane.at(0, 0), 1);
  EXPECT_EQ(pick_channels(image, "a").layers[0].plane.at(0, 0), 0);
}

TEST(Channels, OfAGreyImageAreAllTheSame) {
  const Layers grey = make_layers({1, 1}, {"Y"});
  EXPECT_EQ(pick_channels(grey, "rgb").layers.size(), 3u);
  EXPECT_TRUE(has_channels({"Y"}, "g"));
  EXPECT_FALSE(has_channels({"Y"}, "a"));
  EXPECT_TRUE(has_channels({"Y", "A"}, "rgb"));
}

TEST(Channels, AreFoundBehindTheNameOfALayer) {
  EXPECT_TRUE(has_channels({"diffuse.R", "diffuse.G", "diffuse.B"}, "rgb"));
  EXPECT_TRUE(has_channels({"X", "Y", "Z"}, "rgb"));
}

TEST(Channels, OfANormalMapMayLackBlueButAGreyOneStaysOnePlane) {
  EXPECT_EQ(pick_slot(make_layers({1, 1}, {"R", "G"}), Slot::Normal, "rgb").layers.size(), 2u);
  EXPECT_EQ(pick_slot(make_layers({1, 1}, {"R", "G", "B"}), Slot::Normal, "rgb").layers.size(), 3u);
  EXPECT_EQ(pick_slot(make_layers({1, 1}, {"Y"}), Slot::Normal, "rgb").layers.size(), 1u);
  EXPECT_EQ(pick_slot(make_layers({1, 1}, {"Y"}), Slot::BaseColor, "rgb").layers.size(), 3u);
}

TEST(Channels, ThatAreNotThereAreAnInputErrorThatSaysWhatIs) {
  const Layers image = make_layers({1, 1}, {"R", "G", "B"});
  try {
    pick_channels(image, "a");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::Input);
    EXPECT_THAT(error.what(), testing::HasSubstr("R, G, B"));
  }
}

}  // namespace
}  // namespace kiln

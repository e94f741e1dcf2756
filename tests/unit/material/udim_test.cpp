// SPDX-License-Identifier: Apache-2.0
#include "kiln/material/udim.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace kiln {
namespace {

using testing::ElementsAre;

struct Spelling {
  std::string pattern;
  std::string tile_1001, tile_1013;
};

TEST(TilePatterns, NameTheirTilesAndAreFoundBack) {
  for (const Spelling& spelling : {Spelling{"a.<UDIM>.png", "a.1001.png", "a.1013.png"},
                                   {"a.<udim>.png", "a.1001.png", "a.1013.png"},
                                   {"a_%(UDIM)d.exr", "a_1001.exr", "a_1013.exr"},
                                   {"$udim.tif", "1001.tif", "1013.tif"},
                                   {"a_<UVTILE>.png", "a_u1_v1.png", "a_u3_v2.png"},
                                   {"a_<uvtile>.png", "a_u0_v0.png", "a_u2_v1.png"},
                                   {"a_<U>x<V>.png", "a_1x1.png", "a_3x2.png"},
                                   {"a_u<u>v<v>", "a_u0v0", "a_u2v1"}}) {
    EXPECT_TRUE(has_tile(spelling.pattern));
    EXPECT_EQ(tile_name(spelling.pattern, 1001), spelling.tile_1001);
    EXPECT_EQ(tile_name(spelling.pattern, 1013), spelling.tile_1013);
    EXPECT_EQ(tile_of(spelling.pattern, spelling.tile_1001), 1001) << spelling.pattern;
    EXPECT_EQ(tile_of(spelling.pattern, spelling.tile_1013), 1013) << spelling.pattern;
  }
}

TEST(TilePatterns, MatchNothingElse) {
  EXPECT_FALSE(has_tile("a_u1_v1.1001.png"));
  EXPECT_EQ(tile_of("a.<UDIM>.png", "a.0999.png"), std::nullopt);
  EXPECT_EQ(tile_of("a.<UDIM>.png", "a.1001.exr"), std::nullopt);
  EXPECT_EQ(tile_of("a.<UDIM>.png", "a.100.png"), std::nullopt);
  EXPECT_EQ(tile_of("a.<UDIM>.png", "b.1001.png"), std::nullopt);
  EXPECT_EQ(tile_of("a_<UVTILE>.png", "a_u0_v1.png"), std::nullopt);
  EXPECT_EQ(tile_of("a_<UVTILE>.png", "a_u11_v1.png"), std::nullopt) << "ten tiles a row";
  EXPECT_EQ(tile_of("<UDIM>_<UDIM>.png", "1001_1002.png"), std::nullopt);
  EXPECT_EQ(tile_of("<UDIM>_<UVTILE>.png", "1012_u2_v2.png"), 1012);
}

TEST(TileNumbers, AreReadWhereANameEndsInOne) {
  EXPECT_EQ(udim_tile("hero_BaseColor.1002.exr"), 1002);
  EXPECT_EQ(udim_tile("hero_BaseColor_2048.exr"), std::nullopt);
  EXPECT_EQ(udim_tile("hero_BaseColor_1024.exr"), std::nullopt);
}

TEST(TileNumbers, OfAFolderBecomeOnePatternAMap) {
  EXPECT_THAT(with_tile_patterns({"a_N.1002.png", "a_C.1001.png", "a_C.1002.png", "AO.png"}),
              ElementsAre("AO.png", "a_C.<UDIM>.png", "a_N.<UDIM>.png"));
  EXPECT_THAT(with_tile_patterns({"a_C.1001.png"}), ElementsAre("a_C.<UDIM>.png"));
  EXPECT_THAT(with_tile_patterns({"a_C_u1_v1.png", "a_C_u2_v1.png"}),
              ElementsAre("a_C_<UVTILE>.png"));
  EXPECT_THAT(with_tile_patterns({"a_C_u1_v1.png", "a_C_u0_v1.png"}),
              ElementsAre("a_C_<uvtile>.png"));
}

TEST(TileNumbers, AloneMayBeAnything) {
  EXPECT_THAT(with_tile_patterns({"a_C_1080.png", "a_R_1080.png", "b_v2.png"}),
              ElementsAre("a_C_1080.png", "a_R_1080.png", "b_v2.png"));
}

}  // namespace
}  // namespace kiln

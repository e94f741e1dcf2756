// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "kiln/pipeline/run.h"
#include "support/workshop.h"

namespace kiln {
namespace {

using test::message_of;
using test::Workshop;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

Plan plan_of(const Workshop& shop, const std::string& text) {
  return make_plan(read_pipeline(shop.write("rocks.yaml", "version: 1\n" + text)), shop / "out");
}

void paint_tiles(const Workshop& shop, const std::string& map, const std::vector<int>& tiles) {
  for (const int tile : tiles) {
    shop.paint("rock/rock_" + map + "." + std::to_string(tile) + ".png", 0.5f, PixelType::Uint8);
  }
}

std::vector<std::string> names_of(const Plan& plan) {
  std::vector<std::string> names;
  for (const PlannedSet& set : plan.sets) names.push_back(set.name);
  return names;
}

TEST(Tiles, OfAFolderAreSetsOfTheirOwn) {
  const Workshop shop;
  paint_tiles(shop, "BaseColor", {1001, 1002, 1011});
  paint_tiles(shop, "Roughness", {1001, 1002, 1011});
  shop.paint("rock/rock_AO.png", 1, PixelType::Uint8);
  const Plan plan = plan_of(shop, "sets: [{ path: rock }]\nbakes: []\n");
  EXPECT_THAT(names_of(plan), ElementsAre("rock.1001", "rock.1002", "rock.1011"));
  EXPECT_EQ(plan.sets[2].tile, 1011);
  EXPECT_EQ(plan.sets[2].maps.at(0).path, shop / "rock/rock_BaseColor.1011.png");
  for (const PlannedSet& set : plan.sets) {
    EXPECT_THAT(set.warnings, IsEmpty());
    const auto shared = std::find_if(set.maps.begin(), set.maps.end(), [](const PlannedMap& map) {
      return map.slot == Slot::AmbientOcclusion;
    });
    ASSERT_NE(shared, set.maps.end());
    EXPECT_EQ(shared->path.filename(), "rock_AO.png");
  }
}

TEST(Tiles, ThatOneMapHasAndAnotherLacksTakeItsConstantAndSaySo) {
  const Workshop shop;
  paint_tiles(shop, "BaseColor", {1001, 1002});
  paint_tiles(shop, "ORM", {1001});
  const Plan plan = plan_of(shop, "sets: [{ path: rock }]\nbakes: []\n");
  ASSERT_EQ(plan.sets.size(), 2u);
  EXPECT_THAT(plan.sets[0].warnings, IsEmpty());
  EXPECT_THAT(plan.sets[1].warnings,
              ElementsAre(AllOf(HasSubstr("tile 1002 lacks roughness, metallic, ambient_occlusion"),
                                HasSubstr("rock_ORM.1002.png"))));
  EXPECT_FALSE(plan.sets[1].fault);
}

TEST(Tiles, WithNothingLeftFailAlone) {
  const Workshop shop;
  paint_tiles(shop, "BaseColor", {1001});
  paint_tiles(shop, "Height", {1001, 1002});
  shop.paint("sky.exr", 1, PixelType::Float, {16, 8});
  const Report report = run_plan(plan_of(shop, R"(
environment: { sky: sky.exr }
sets: [{ path: rock }]
bakes: [{ bake: preview, env: sky, samples: 16, out: "{set}/a.exr" }]
)"),
                                 Records::None);
  ASSERT_EQ(report.tasks.size(), 2u);
  EXPECT_EQ(report.tasks[0].outputs, std::vector<std::string>{"rock.1001/a.exr"});
  ASSERT_TRUE(report.tasks[1].fault);
  EXPECT_EQ(report.tasks[1].fault->fault(), Fault::Input);
  EXPECT_THAT(report.tasks[1].fault->what(), AllOf(HasSubstr("tile 1002"), HasSubstr("base_color"),
                                                   HasSubstr("rock_BaseColor.1002.png")));
}

TEST(Tiles, OfMapsByPatternMayBeSpelledInAnyWay) {
  const Workshop shop;
  paint_tiles(shop, "BaseColor", {1001, 1002});
  shop.paint("rock/r_u1_v1.png", 0.5f, PixelType::Uint8);
  shop.paint("rock/r_u2_v1.png", 0.5f, PixelType::Uint8);
  const Plan plan = plan_of(shop, R"(
sets:
  - name: hero
    maps:
      base_color: rock/rock_BaseColor.%(UDIM)d.png
      roughness: rock/r_<UVTILE>.png
bakes: []
)");
  EXPECT_THAT(names_of(plan), ElementsAre("hero.1001", "hero.1002"));
  EXPECT_EQ(plan.sets[1].maps.at(1).path, shop / "rock/r_u2_v1.png");
}

TEST(Tiles, ThatAreNotThereAtAllAreAnErrorThatNamesThePattern) {
  const Workshop shop;
  const Plan plan = plan_of(shop, R"(
sets: [{ name: hero, maps: { base_color: "none.<UDIM>.png" } }]
bakes: []
)");
  ASSERT_EQ(plan.sets.size(), 1u);
  ASSERT_TRUE(plan.sets[0].fault);
  EXPECT_EQ(plan.sets[0].fault->fault(), Fault::Input);
  EXPECT_THAT(plan.sets[0].fault->what(), HasSubstr("none.<UDIM>.png"));
}

TEST(Tiles, MayStandApartInTheOutput) {
  const Workshop shop;
  paint_tiles(shop, "BaseColor", {1001, 1002});
  const std::string start = "environment: { sky: s.exr }\nsets: [{ path: rock }]\n";
  const Plan plan = plan_of(
      shop, start + "bakes: [{ bake: preview, env: sky, out: \"{set}/flat.{udim}.exr\" }]\n");
  EXPECT_EQ(plan.tasks.at(1).out, "rock/flat.1002.exr");
  shop.paint_set("tex/a");
  EXPECT_THAT(message_of([&] {
                plan_of(shop,
                        "environment: { sky: s.exr }\nsets: [{ path: tex/a }]\n"
                        "bakes: [{ bake: preview, env: sky, out: \"flat.{udim}.exr\" }]\n");
              }),
              HasSubstr("set 'a' has no UDIM tiles"));
}

}  // namespace
}  // namespace kiln

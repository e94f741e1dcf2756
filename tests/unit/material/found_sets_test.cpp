// SPDX-License-Identifier: Apache-2.0
// The folders of real scans, by their literal names and, where they are at hand, by their listing.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "kiln/material/naming.h"
#include "support/real_data.h"

namespace kiln {
namespace {

struct RealFolder {
  std::string name;
  std::vector<std::string> files;
};

const std::vector<RealFolder> real_folders = {
    {"rusty_metal_Metal053C_1k_gl",
     {"albedo.jpg", "displacement.jpg", "metallic.jpg", "normal.jpg", "roughness.jpg"}},
    {"rock_Rock020_1k_dx",
     {"Rock020_1K_AmbientOcclusion.jpg", "Rock020_1K_Color.jpg", "Rock020_1K_Displacement.jpg",
      "Rock020_1K_Normal.jpg", "Rock020_1K_Roughness.jpg"}},
    {"copper_tiles_01_2k",
     {"Copper_tiles_01_AO.png", "Copper_tiles_01_Color.png", "Copper_tiles_01_Metallic.png",
      "Copper_tiles_01_Normal.png", "Copper_tiles_01_Roughness.png"}},
    {"fabric_Fabric02_2048x2463_nonormal",
     {"DERIVED_height16_1024.png", "fabric02_col.jpg", "fabric02_disp.jpg", "fabric02_rgh.jpg"}},
    {"boombox_gltf_orm_2k",
     {"BoomBox_baseColor.png", "BoomBox_emissive.png", "BoomBox_normal.png",
      "BoomBox_occlusionRoughnessMetallic.png"}},
    {"panel_gltf_mr_and_specgloss_1k",
     {"baseColor_alpha.png", "emissive.png", "metallicRoughness_gltf.png", "normal.png",
      "occlusion.png", "sg_diffuse_alpha.png", "sg_specularGlossiness.png"}},
    {"udim_grid_512",
     {"grid.1001.png", "grid.1002.png", "grid.1003.png", "grid.1011.png", "grid.1012.png",
      "grid.1013.png"}},
};

std::vector<FoundSet> sets_of(const std::string& folder) {
  for (const RealFolder& real : real_folders) {
    if (real.name == folder) return find_sets(folder, real.files);
  }
  return {};
}

// slot name -> "file:channels", optional sources in brackets.
std::map<std::string, std::string> table_of(const FoundSet& set) {
  std::map<std::string, std::string> table;
  for (const MapSource& map : set.maps) {
    const std::string source = map.file + ":" + map.channels;
    table[std::string(slot_name(map.slot))] = map.if_present ? "[" + source + "]" : source;
  }
  return table;
}

using Table = std::map<std::string, std::string>;

TEST(FoundSets, OfTheRustyMetalFillFiveSlotsFromPlainWords) {
  const auto sets = sets_of("rusty_metal_Metal053C_1k_gl");
  ASSERT_EQ(sets.size(), 1u);
  EXPECT_EQ(sets[0].name, "rusty_metal_Metal053C_1k_gl");
  EXPECT_EQ(sets[0].workflow, Workflow::MetalRough);
  EXPECT_EQ(table_of(sets[0]), (Table{{"base_color", "albedo.jpg:rgb"},
                                      {"opacity", "[albedo.jpg:a]"},
                                      {"roughness", "roughness.jpg:r"},
                                      {"metallic", "metallic.jpg:r"},
                                      {"normal", "normal.jpg:rgb"},
                                      {"height", "displacement.jpg:r"}}));
  EXPECT_TRUE(sets[0].ignored.empty());
}

TEST(FoundSets, OfTheRockFollowAmbientCgAndLeaveTheConventionOpen) {
  const auto sets = sets_of("rock_Rock020_1k_dx");
  ASSERT_EQ(sets.size(), 1u);
  EXPECT_EQ(table_of(sets[0]), (Table{{"base_color", "Rock020_1K_Color.jpg:rgb"},
                                      {"opacity", "[Rock020_1K_Color.jpg:a]"},
                                      {"roughness", "Rock020_1K_Roughness.jpg:r"},
                                      {"normal", "Rock020_1K_Normal.jpg:rgb"},
                                      {"ambient_occlusion", "Rock020_1K_AmbientOcclusion.jpg:r"},
                                      {"height", "Rock020_1K_Displacement.jpg:r"}}));
  for (const MapSource& map : sets[0].maps) EXPECT_EQ(map.scheme, "ambientcg") << map.file;
  for (const MapSource& map : sets[0].maps) EXPECT_EQ(map.convention, NormalConvention::Auto);
}

TEST(FoundSets, OfTheCopperTilesFillFiveSlots) {
  const auto sets = sets_of("copper_tiles_01_2k");
  ASSERT_EQ(sets.size(), 1u);
  EXPECT_EQ(table_of(sets[0]), (Table{{"base_color", "Copper_tiles_01_Color.png:rgb"},
                                      {"opacity", "[Copper_tiles_01_Color.png:a]"},
                                      {"roughness", "Copper_tiles_01_Roughness.png:r"},
                                      {"metallic", "Copper_tiles_01_Metallic.png:r"},
                                      {"normal", "Copper_tiles_01_Normal.png:rgb"},
                                      {"ambient_occlusion", "Copper_tiles_01_AO.png:r"}}));
}

TEST(FoundSets, OfTheFabricTakeOneHeightMapAndReportTheOther) {
  const auto sets = sets_of("fabric_Fabric02_2048x2463_nonormal");
  ASSERT_EQ(sets.size(), 1u);
  EXPECT_EQ(table_of(sets[0]), (Table{{"base_color", "fabric02_col.jpg:rgb"},
                                      {"opacity", "[fabric02_col.jpg:a]"},
                                      {"roughness", "fabric02_rgh.jpg:r"},
                                      {"height", "fabric02_disp.jpg:r"}}));
  ASSERT_EQ(sets[0].ignored.size(), 1u);
  EXPECT_EQ(sets[0].ignored[0].file, "DERIVED_height16_1024.png");
  EXPECT_THAT(sets[0].ignored[0].reason, testing::HasSubstr("fabric02_disp.jpg"));
}

TEST(FoundSets, OfTheBoomBoxUnpackOcclusionRoughnessAndMetallic) {
  const auto sets = sets_of("boombox_gltf_orm_2k");
  ASSERT_EQ(sets.size(), 1u);
  EXPECT_EQ(table_of(sets[0]),
            (Table{{"base_color", "BoomBox_baseColor.png:rgb"},
                   {"opacity", "[BoomBox_baseColor.png:a]"},
                   {"emissive", "BoomBox_emissive.png:rgb"},
                   {"normal", "BoomBox_normal.png:rgb"},
                   {"ambient_occlusion", "BoomBox_occlusionRoughnessMetallic.png:r"},
                   {"roughness", "BoomBox_occlusionRoughnessMetallic.png:g"},
                   {"metallic", "BoomBox_occlusionRoughnessMetallic.png:b"}}));
}

TEST(FoundSets, OfThePanelAreTwoThatShareNormalAndOcclusion) {
  const auto sets = sets_of("panel_gltf_mr_and_specgloss_1k");
  ASSERT_EQ(sets.size(), 2u);
  EXPECT_EQ(sets[0].name, "panel_gltf_mr_and_specgloss_1k.metal_rough");
  EXPECT_EQ(sets[0].workflow, Workflow::MetalRough);
  EXPECT_EQ(table_of(sets[0]), (Table{{"base_color", "baseColor_alpha.png:rgb"},
                                      {"opacity", "baseColor_alpha.png:a"},
                                      {"emissive", "emissive.png:rgb"},
                                      {"roughness", "metallicRoughness_gltf.png:g"},
                                      {"metallic", "metallicRoughness_gltf.png:b"},
                                      {"normal", "normal.png:rgb"},
                                      {"ambient_occlusion", "occlusion.png:r"}}));
  EXPECT_EQ(sets[1].name, "panel_gltf_mr_and_specgloss_1k.spec_gloss");
  EXPECT_EQ(sets[1].workflow, Workflow::SpecGloss);
  EXPECT_EQ(table_of(sets[1]), (Table{{"diffuse", "sg_diffuse_alpha.png:rgb"},
                                      {"opacity", "sg_diffuse_alpha.png:a"},
                                      {"emissive", "emissive.png:rgb"},
                                      {"specular_color", "sg_specularGlossiness.png:rgb"},
                                      {"gloss", "sg_specularGlossiness.png:a"},
                                      {"normal", "normal.png:rgb"},
                                      {"ambient_occlusion", "occlusion.png:r"}}));
  EXPECT_EQ(sets[0].ignored.size(), 2u);
  EXPECT_EQ(sets[1].ignored.size(), 2u);
}

TEST(FoundSets, OfThePanelTakeTheNormalConventionOfGltf) {
  for (const FoundSet& set : sets_of("panel_gltf_mr_and_specgloss_1k")) {
    for (const MapSource& map : set.maps) {
      if (map.slot != Slot::Normal) continue;
      EXPECT_EQ(map.convention, NormalConvention::OpenGl);
    }
  }
}

TEST(FoundSets, OfThePanelAreOneWhenTheWorkflowIsStated) {
  const RealFolder& panel = real_folders[5];
  const auto sets = find_sets(panel.name, panel.files, {{}, Workflow::SpecGloss});
  ASSERT_EQ(sets.size(), 1u);
  EXPECT_EQ(sets[0].name, panel.name);
  EXPECT_EQ(table_of(sets[0]).at("diffuse"), "sg_diffuse_alpha.png:rgb");
  EXPECT_EQ(table_of(sets[0]).count("metallic"), 0u);
}

TEST(FoundSets, OfAFolderOfBareUdimTilesAreNone) { EXPECT_TRUE(sets_of("udim_grid_512").empty()); }

TEST(FoundSets, OfTheFoldersOnDiskAreThoseOfTheLiteralNames) {
  KILN_REQUIRE_REAL_DATA(data);
  for (const RealFolder& real : real_folders) {
    std::vector<std::string> files;
    for (const auto& entry :
         std::filesystem::directory_iterator(data / "data" / "materials" / real.name)) {
      files.push_back(entry.path().filename().string());
    }
    const auto on_disk = find_sets(real.name, files);
    const auto literal = find_sets(real.name, real.files);
    ASSERT_EQ(on_disk.size(), literal.size()) << real.name;
    for (size_t i = 0; i < on_disk.size(); ++i) {
      EXPECT_EQ(table_of(on_disk[i]), table_of(literal[i])) << real.name;
    }
  }
}

}  // namespace
}  // namespace kiln

// SPDX-License-Identifier: Apache-2.0
#include "kiln/material/naming.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <set>

#include "kiln/core/error.h"

namespace kiln {
namespace {

// The set of a folder that holds these files, which must be one.
FoundSet only_set(const std::vector<std::string>& files, const NamingRules& rules = {}) {
  const std::vector<FoundSet> sets = find_sets("rock", files, rules);
  EXPECT_EQ(sets.size(), 1u);
  return sets.empty() ? FoundSet{} : sets[0];
}

const MapSource* find(const FoundSet& set, Slot slot) {
  for (const MapSource& map : set.maps) {
    if (map.slot == slot) return &map;
  }
  return nullptr;
}

// "file:channels" of a slot, or empty.
std::string source(const FoundSet& set, Slot slot) {
  const MapSource* map = find(set, slot);
  return map ? map->file + ":" + map->channels : "";
}

TEST(NamingSchemes, HaveNamesMeaningsAndTokensThatResolveToSlots) {
  std::set<std::string_view> names;
  for (const NamingScheme& scheme : all_naming_schemes()) {
    EXPECT_TRUE(names.insert(scheme.name).second) << scheme.name;
    EXPECT_FALSE(scheme.meaning.empty());
    EXPECT_EQ(&find_naming_scheme(scheme.name), &scheme);
    for (const NamingToken& token : scheme.tokens) {
      ASSERT_FALSE(token.targets.empty()) << token.token;
      for (const TokenTarget& target : token.targets) {
        const size_t channels = target.channels.size();
        EXPECT_EQ(static_cast<int>(channels), slot_facts(target.slot).channels) << token.token;
      }
    }
  }
}

// A file that makes a set of any scheme: one whose whole is the base colour.
std::string base_color_file(const NamingScheme& scheme) {
  for (const NamingToken& token : scheme.tokens) {
    const bool whole = token.targets.size() == 1 && token.targets[0].slot == Slot::BaseColor;
    if (whole) return "wall_" + std::string(token.token) + ".png";
  }
  return "";
}

TEST(NamingSchemes, FindEachOfTheirOwnTokensAtTheEndOfAName) {
  for (const NamingScheme& scheme : all_naming_schemes()) {
    for (const NamingToken& token : scheme.tokens) {
      const std::string file = "wall_" + std::string(token.token) + "_2k.png";
      std::vector<std::string> files = {file};
      if (token.targets[0].slot != Slot::BaseColor) files.push_back(base_color_file(scheme));
      const FoundSet set = only_set(files, {{std::string(scheme.name)}, {}});
      const bool found = std::any_of(set.maps.begin(), set.maps.end(), [&](const MapSource& map) {
        return map.file == file && map.token == token.token && map.scheme == scheme.name;
      });
      EXPECT_TRUE(found) << scheme.name << " " << token.token;
    }
  }
}

TEST(NamingSchemes, SpellNoTokenTwice) {
  for (const NamingScheme& scheme : all_naming_schemes()) {
    std::set<std::string> spelled;
    for (const NamingToken& token : scheme.tokens) {
      std::string letters;
      for (const char c : token.token) {
        if (c != '_') letters += static_cast<char>(std::tolower(c));
      }
      EXPECT_TRUE(spelled.insert(letters).second) << scheme.name << " " << token.token;
    }
  }
}

TEST(NamingSchemes, AreRefusedWhenUnknownNamingTheNearest) {
  try {
    find_sets("rock", {"a_color.png"}, {{"ambientgc"}, {}});
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::Usage);
    EXPECT_THAT(error.what(), testing::HasSubstr("did you mean 'ambientcg'"));
  }
}

TEST(NamingSchemes, FindTheGreenChannelOfAnOrmFileAsRoughness) {
  const FoundSet set = only_set({"T_Rock_D.png", "T_Rock_ORM.png", "T_Rock_N.png"});
  EXPECT_EQ(source(set, Slot::AmbientOcclusion), "T_Rock_ORM.png:r");
  EXPECT_EQ(source(set, Slot::Roughness), "T_Rock_ORM.png:g");
  EXPECT_EQ(source(set, Slot::Metallic), "T_Rock_ORM.png:b");
  EXPECT_EQ(source(set, Slot::BaseColor), "T_Rock_D.png:rgb");
  EXPECT_EQ(source(set, Slot::Normal), "T_Rock_N.png:rgb");
}

TEST(NamingSchemes, ReadAPolyHavenSetWithItsPackedFile) {
  const FoundSet set = only_set({"rusty_metal_02_arm_2k.png", "rusty_metal_02_diff_2k.jpg",
                                 "rusty_metal_02_nor_gl_2k.exr", "rusty_metal_02_disp_2k.png"});
  EXPECT_EQ(source(set, Slot::BaseColor), "rusty_metal_02_diff_2k.jpg:rgb");
  EXPECT_EQ(source(set, Slot::Roughness), "rusty_metal_02_arm_2k.png:g");
  EXPECT_EQ(source(set, Slot::Metallic), "rusty_metal_02_arm_2k.png:b");
  EXPECT_EQ(find(set, Slot::Normal)->convention, NormalConvention::OpenGl);
  EXPECT_TRUE(set.ignored.empty());
}

TEST(NamingSchemes, PreferTheOpenGlFileWhereBothConventionsAreThere) {
  const FoundSet set =
      only_set({"Rock_1K_NormalDX.jpg", "Rock_1K_NormalGL.jpg", "Rock_1K_Color.jpg"});
  EXPECT_EQ(source(set, Slot::Normal), "Rock_1K_NormalGL.jpg:rgb");
  EXPECT_EQ(find(set, Slot::Normal)->convention, NormalConvention::OpenGl);
  ASSERT_EQ(set.ignored.size(), 1u);
  EXPECT_EQ(set.ignored[0].file, "Rock_1K_NormalDX.jpg");
}

TEST(NamingSchemes, ReadTheDirectXConventionOffTheName) {
  EXPECT_EQ(find(only_set({"a_NormalDX.png"}), Slot::Normal)->convention,
            NormalConvention::DirectX);
  EXPECT_EQ(find(only_set({"a_normal_directx.png"}), Slot::Normal)->convention,
            NormalConvention::DirectX);
  EXPECT_EQ(find(only_set({"a_Normal.png"}), Slot::Normal)->convention, NormalConvention::Auto);
}

TEST(NamingSchemes, LetTheLastTokenOfANameWin) {
  EXPECT_EQ(source(only_set({"Metal053C_1K_Roughness.jpg"}), Slot::Roughness),
            "Metal053C_1K_Roughness.jpg:r");
  EXPECT_EQ(source(only_set({"rough_wood_diff_1k.jpg"}), Slot::BaseColor),
            "rough_wood_diff_1k.jpg:rgb");
}

TEST(NamingSchemes, TakeNoMaterialsNameForAMap) {
  EXPECT_TRUE(
      find_sets("metal", {"rusty_metal_preview.png", "metal_plate.png", "Wood049D.png"}).empty());
}

TEST(NamingSchemes, SeeThroughResolutionTileAndQualifiersBehindTheToken) {
  for (const char* file : {"a_rough_4k.png", "a-Roughness-2048x2048.png", "a roughness 1002.png",
                           "aRoughness.exr", "A_ROUGHNESS_8bit.tif", "a_rough.<UDIM>.exr",
                           "a_roughness_<UVTILE>.png", "roughness.jpg"}) {
    EXPECT_EQ(source(only_set({file}), Slot::Roughness), std::string(file) + ":r") << file;
  }
}

TEST(NamingSchemes, ReadAUnityMaskMap) {
  const FoundSet set = only_set({"Rock_AlbedoTransparency.png", "Rock_MaskMap.png"});
  EXPECT_EQ(source(set, Slot::Metallic), "Rock_MaskMap.png:r");
  EXPECT_EQ(source(set, Slot::AmbientOcclusion), "Rock_MaskMap.png:g");
  EXPECT_EQ(source(set, Slot::Gloss), "Rock_MaskMap.png:a");
  EXPECT_EQ(source(set, Slot::Opacity), "Rock_AlbedoTransparency.png:a");
}

TEST(NamingSchemes, TakeAlphaOfTheBaseColourAsOpacityIfItIsThere) {
  const FoundSet set = only_set({"Box_baseColor.png"});
  ASSERT_NE(find(set, Slot::Opacity), nullptr);
  EXPECT_EQ(source(set, Slot::Opacity), "Box_baseColor.png:a");
  EXPECT_TRUE(find(set, Slot::Opacity)->if_present);
  EXPECT_EQ(find(set, Slot::Opacity)->color_space, "data");
}

TEST(NamingSchemes, PreferAFileOfItsOwnToAChannelOfAPackedOne) {
  const FoundSet set = only_set({"a_arm.png", "a_rough.png", "a_diff.png"});
  EXPECT_EQ(source(set, Slot::Roughness), "a_rough.png:r");
  EXPECT_EQ(source(set, Slot::Metallic), "a_arm.png:b");
  ASSERT_EQ(set.ignored.size(), 1u);
  EXPECT_THAT(set.ignored[0].reason, testing::HasSubstr("channel g"));
}

TEST(NamingSchemes, FollowTheOrderOfPreferenceBetweenTwoFilesForOneSlot) {
  const std::vector<std::string> files = {"a_disp.png", "a_Height.png", "a_diff.png"};
  EXPECT_EQ(source(only_set(files), Slot::Height), "a_disp.png:r");
  EXPECT_EQ(source(only_set(files, {{"substance", "polyhaven"}, {}}), Slot::Height),
            "a_Height.png:r");
}

TEST(NamingSchemes, WarnOfTwoFilesForOneSlotThatSpellTheSameToken) {
  const FoundSet set = only_set({"brick_color.png", "wood_color.png"});
  EXPECT_EQ(source(set, Slot::BaseColor), "brick_color.png:rgb");
  ASSERT_EQ(set.warnings.size(), 1u);
  EXPECT_THAT(set.warnings[0], testing::HasSubstr("wood_color.png"));
}

TEST(NamingSchemes, ReportEveryFileThatIsNoMap) {
  const FoundSet set =
      only_set({"a_color.png", "source.md", ".DS_Store", "a_preview.jpg", "holiday.png"});
  EXPECT_EQ(set.ignored.size(), 4u);
  for (const IgnoredFile& ignored : set.ignored) EXPECT_FALSE(ignored.reason.empty());
}

TEST(NamingSchemes, DoNotDependOnTheOrderOfFiles) {
  std::vector<std::string> files = {"a_color.png", "b_color.png", "a_arm.png", "a_rough.png"};
  const FoundSet first = only_set(files);
  std::reverse(files.begin(), files.end());
  const FoundSet second = only_set(files);
  ASSERT_EQ(first.maps.size(), second.maps.size());
  for (size_t i = 0; i < first.maps.size(); ++i) {
    EXPECT_EQ(first.maps[i].file, second.maps[i].file);
  }
}

TEST(NamingSchemes, TakeTheTilesOfAMapAsOneFile) {
  const FoundSet set =
      only_set({"hero_BaseColor.1001.exr", "hero_BaseColor.1002.exr", "hero_Roughness.1001.exr"});
  EXPECT_EQ(source(set, Slot::BaseColor), "hero_BaseColor.<UDIM>.exr:rgb");
  EXPECT_EQ(source(set, Slot::Roughness), "hero_Roughness.<UDIM>.exr:r");
  EXPECT_TRUE(set.warnings.empty());
}

TEST(NamingSchemes, ResolveTheClashOfOneLetterByTheirOrderAndSaySo) {
  const FoundSet set = only_set({"rock_d.png", "rock_r.png"});
  EXPECT_EQ(source(set, Slot::BaseColor), "rock_d.png:rgb");
  EXPECT_THAT(find(set, Slot::BaseColor)->reason, testing::HasSubstr("o3de reads it as height"));
  const auto stated =
      find_sets("rock", {"rock_d.png", "rock_bc.png", "rock_mt.png"}, {{"o3de"}, std::nullopt});
  ASSERT_EQ(stated.size(), 1u);
  EXPECT_EQ(source(stated[0], Slot::Height), "rock_d.png:r");
  EXPECT_EQ(source(stated[0], Slot::Metallic), "rock_mt.png:r");
}

TEST(NamingSchemes, TakeNamesThatAllBeginWithTForUnreals) {
  const FoundSet set = only_set({"T_Rock_BC.png", "T_Rock_N.png", "T_Rock_MRA.png", "notes.txt"});
  EXPECT_EQ(find(set, Slot::Normal)->scheme, "unreal");
  EXPECT_EQ(find(set, Slot::Normal)->convention, NormalConvention::DirectX);
  EXPECT_EQ(source(set, Slot::AmbientOcclusion), "T_Rock_MRA.png:b");
  const FoundSet mixed = only_set({"T_Rock_BC.png", "Rock_N.png"});
  EXPECT_EQ(find(mixed, Slot::Normal)->convention, NormalConvention::Auto);
}

TEST(NamingSchemes, OfBlenderTakeBumpsForHeightAndNormalsThatPointUp) {
  const std::vector<std::string> files{"wood_col.png", "wood_nrm.png", "wood_bump.png"};
  EXPECT_EQ(source(only_set(files), Slot::Height), "wood_bump.png:r");
  EXPECT_EQ(find(only_set(files), Slot::Normal)->convention, NormalConvention::Auto);
  const FoundSet stated = only_set(files, {{"blender"}, std::nullopt});
  EXPECT_EQ(find(stated, Slot::Normal)->convention, NormalConvention::OpenGl);
}

TEST(NamingSchemes, ReadTheWorkflowThatIsCompleteAndWarnOfTheOther) {
  const FoundSet metal =
      only_set({"a_BaseColor.png", "a_Metallic.png", "a_Roughness.png", "a_Diffuse.png"});
  EXPECT_EQ(metal.workflow, Workflow::MetalRough);
  ASSERT_EQ(metal.warnings.size(), 1u);
  EXPECT_THAT(metal.warnings[0], testing::HasSubstr("diffuse belongs to another workflow, which "
                                                    "lacks specular_color; metal-rough is read"));
  const FoundSet gloss =
      only_set({"a_Diffuse.png", "a_Specular.png", "a_Glossiness.png", "a_Metallic.png"});
  EXPECT_EQ(gloss.workflow, Workflow::SpecGloss);
  ASSERT_EQ(gloss.warnings.size(), 1u);
  EXPECT_THAT(gloss.warnings[0], testing::HasSubstr("lacks base_color; spec-gloss is read"));
}

TEST(ColorSpaceDecision, IsSrgbForPicturesLinearForExrAndDataForNumbers) {
  const FoundSet set = only_set({"a_color.png", "a_roughness.png", "a_normal.exr"});
  EXPECT_EQ(find(set, Slot::BaseColor)->color_space, "srgb_rec709_scene");
  EXPECT_EQ(find(set, Slot::Roughness)->color_space, "data");
  EXPECT_EQ(find(set, Slot::Normal)->color_space, "data");
  EXPECT_EQ(find(only_set({"a_color.exr"}), Slot::BaseColor)->color_space, "lin_rec709_scene");
  for (const MapSource& map : set.maps) EXPECT_FALSE(map.color_space_reason.empty());
}

TEST(SpecularToken, IsALevelBesideAMetallicMapAndAColourElsewhere) {
  const FoundSet metal = only_set({"a_color.png", "a_metallic.png", "a_specular.png"});
  EXPECT_EQ(source(metal, Slot::SpecularLevel), "a_specular.png:r");
  EXPECT_EQ(metal.workflow, Workflow::MetalRough);
  const FoundSet rough = only_set({"a_albedo.png", "a_specular.png", "a_roughness.png"});
  EXPECT_EQ(source(rough, Slot::SpecularColor), "a_specular.png:rgb");
  EXPECT_EQ(rough.workflow, Workflow::AlbedoSpecularRoughness);
  EXPECT_FALSE(rough.warnings.empty());
  const FoundSet gloss = only_set({"a_diffuse.png", "a_specular.png", "a_glossiness.png"});
  EXPECT_EQ(source(gloss, Slot::SpecularColor), "a_specular.png:rgb");
  EXPECT_EQ(gloss.workflow, Workflow::SpecGloss);
}

TEST(SpecularToken, FollowsAStatedWorkflow) {
  const std::vector<std::string> files = {"a_albedo.png", "a_specular.png", "a_roughness.png"};
  const FoundSet set = only_set(files, {{}, Workflow::MetalRough});
  EXPECT_EQ(source(set, Slot::SpecularLevel), "a_specular.png:r");
  EXPECT_EQ(set.workflow_reason, "as stated");
}

}  // namespace
}  // namespace kiln

// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "kiln/core/error.h"
#include "kiln/material/workflow.h"

namespace kiln {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;

SlotMap constant(float r, float g, float b) {
  SlotMap map;
  map.value = {r, g, b};
  return map;
}
SlotMap constant(float v) { return constant(v, v, v); }

SlotMap image(Size size, const std::vector<float>& values, const std::string& source = "map") {
  const std::vector<std::string> names = {"R", "G", "B", "A"};
  SlotMap map;
  map.image.size = size;
  for (size_t i = 0; i < values.size(); ++i) map.image.add(names[i], values[i]);
  map.source = source;
  return map;
}

std::array<float, 3> texel(const std::array<Plane, 3>& planes, int x = 0, int y = 0) {
  return {planes[0].at(x, y), planes[1].at(x, y), planes[2].at(x, y)};
}

void expect_near(const std::array<float, 3>& actual, const std::array<float, 3>& expected) {
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(actual[c], expected[c], 1e-6) << "channel " << c;
}

TEST(Resolving, GivesAMetalItsBaseColourAsReflectanceAndNoDiffuse) {
  const Resolved metal =
      resolve({{Slot::BaseColor, constant(0.9f, 0.6f, 0.3f)}, {Slot::Metallic, constant(1)}}, {});
  expect_near(texel(metal.svbrdf.f0), {0.9f, 0.6f, 0.3f});
  expect_near(texel(metal.svbrdf.diffuse_color), {0, 0, 0});
}

TEST(Resolving, GivesADielectricFourPercentAndItsBaseColourAsDiffuse) {
  const Resolved plastic = resolve({{Slot::BaseColor, constant(0.9f, 0.6f, 0.3f)}}, {});
  expect_near(texel(plastic.svbrdf.f0), {0.04f, 0.04f, 0.04f});
  expect_near(texel(plastic.svbrdf.diffuse_color), {0.9f, 0.6f, 0.3f});
}

TEST(Resolving, MixesHalfMetalsLinearly) {
  const Resolved half = resolve({{Slot::BaseColor, constant(0.8f)},
                                 {Slot::Metallic, constant(0.25f)},
                                 {Slot::SpecularLevel, constant(1)}},
                                {});
  expect_near(texel(half.svbrdf.diffuse_color), {0.6f, 0.6f, 0.6f});
  EXPECT_NEAR(half.svbrdf.f0[0].at(0, 0), 0.75f * 0.08f + 0.25f * 0.8f, 1e-6);
}

TEST(Resolving, ReadsTheSpecularLevelInItsEncoding) {
  SlotMap ior = constant(1.33f);
  ior.encoding = SpecularEncoding::Ior;
  const Resolved water = resolve({{Slot::SpecularLevel, ior}}, {});
  EXPECT_NEAR(water.svbrdf.f0[0].at(0, 0), 0.0200593, 1e-6);
  EXPECT_TRUE(water.warnings.empty());
}

TEST(Resolving, TakesSpecGlossAsItIsAndTurnsGlossIntoRoughness) {
  const Resolved resolved = resolve({{Slot::Diffuse, constant(0.5f, 0.4f, 0.3f)},
                                     {Slot::SpecularColor, constant(0.2f, 0.1f, 0.05f)},
                                     {Slot::Gloss, constant(0.7f)}},
                                    {.workflow = Workflow::SpecGloss});
  expect_near(texel(resolved.svbrdf.diffuse_color), {0.5f, 0.4f, 0.3f});
  expect_near(texel(resolved.svbrdf.f0), {0.2f, 0.1f, 0.05f});
  EXPECT_NEAR(resolved.svbrdf.roughness.at(0, 0), 0.3f, 1e-6);
}

TEST(Resolving, AgreesBetweenTheTwoExportsOfOneSurface) {
  for (const float metal : {0.0f, 0.3f, 1.0f}) {
    const float base = 0.7f;
    const Resolved a = resolve({{Slot::BaseColor, constant(base)},
                                {Slot::Metallic, constant(metal)},
                                {Slot::Roughness, constant(0.4f)}},
                               {});
    const Resolved b = resolve({{Slot::Diffuse, constant(base * (1 - metal))},
                                {Slot::SpecularColor, constant(0.04f + metal * (base - 0.04f))},
                                {Slot::Gloss, constant(0.6f)}},
                               {.workflow = Workflow::SpecGloss});
    expect_near(texel(a.svbrdf.diffuse_color), texel(b.svbrdf.diffuse_color));
    expect_near(texel(a.svbrdf.f0), texel(b.svbrdf.f0));
    EXPECT_NEAR(a.svbrdf.roughness.at(0, 0), b.svbrdf.roughness.at(0, 0), 1e-6);
  }
}

TEST(Resolving, ReadsASpecularColourOrALevelBesideAlbedoAndRoughness) {
  const WorkflowSettings settings{.workflow = Workflow::AlbedoSpecularRoughness};
  SlotMaps maps = {{Slot::BaseColor, constant(0.5f)}, {Slot::Roughness, constant(0.2f)}};
  SlotMaps with_color = maps;
  with_color[Slot::SpecularColor] = constant(0.3f, 0.2f, 0.1f);
  SlotMaps with_level = maps;
  with_level[Slot::SpecularLevel] = constant(1);
  expect_near(texel(resolve(with_color, settings).svbrdf.f0), {0.3f, 0.2f, 0.1f});
  expect_near(texel(resolve(with_level, settings).svbrdf.f0), {0.08f, 0.08f, 0.08f});
  expect_near(texel(resolve(maps, settings).svbrdf.f0), {0.04f, 0.04f, 0.04f});
}

TEST(Resolving, AcceptsGlossWhereRoughnessIsWantedAndSaysSo) {
  const Resolved resolved = resolve({{Slot::Gloss, image({2, 2}, {0.75f})}}, {});
  EXPECT_NEAR(resolved.svbrdf.roughness.at(1, 1), 0.25f, 1e-6);
  EXPECT_THAT(resolved.notes, Contains(HasSubstr("gloss is read instead")));
}

TEST(Resolving, NotesEveryMissingMapAndItsConstant) {
  const Resolved resolved = resolve({}, {});
  EXPECT_EQ(resolved.svbrdf.size, (Size{1, 1}));
  for (const char* name : {"base_color: no map, constant 0.8", "roughness: no map, constant 1",
                           "metallic: no map, constant 0", "specular_level: no map, constant 0.5",
                           "normal: no map, flat", "ambient_occlusion: no map, constant 1"}) {
    EXPECT_THAT(resolved.notes, Contains(name));
  }
  expect_near(texel(resolved.svbrdf.normal), {0, 0, 1});
}

TEST(Resolving, ResamplesToTheLargestMapAndSaysSo) {
  const Resolved resolved = resolve({{Slot::BaseColor, image({8, 8}, {0.5f, 0.5f, 0.5f})},
                                     {Slot::Roughness, image({4, 4}, {0.3f})},
                                     {Slot::Normal, image({2, 2}, {0.5f, 0.5f, 1.0f})}},
                                    {.normal = NormalConvention::OpenGl});
  EXPECT_EQ(resolved.svbrdf.size, (Size{8, 8}));
  for (const Plane* plane : {&resolved.svbrdf.roughness, &resolved.svbrdf.normal[2],
                             &resolved.svbrdf.ambient_occlusion, &resolved.svbrdf.f0[1]}) {
    EXPECT_EQ(plane->size(), (Size{8, 8}));
  }
  EXPECT_THAT(resolved.notes, Contains("roughness 4x4 resampled to 8x8"));
  EXPECT_THAT(resolved.notes, Contains("normal 2x2 resampled to 8x8"));
}

TEST(Resolving, RefusesMapsWhoseAspectsDifferAndNamesBoth) {
  try {
    resolve({{Slot::BaseColor, image({8, 8}, {0.5f, 0.5f, 0.5f}, "c.png")},
             {Slot::Roughness, image({8, 4}, {0.3f}, "r.png")}},
            {});
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::Input);
    EXPECT_THAT(error.what(), HasSubstr("base_color c.png (8x8)"));
    EXPECT_THAT(error.what(), HasSubstr("roughness r.png (8x4) cannot belong together"));
  }
  const Resolved rounded = resolve({{Slot::BaseColor, image({333, 100}, {0.5f, 0.5f, 0.5f})},
                                    {Slot::Roughness, image({83, 25}, {0.3f})},
                                    {Slot::Metallic, image({1, 1}, {0.3f})}},
                                   {});
  EXPECT_EQ(rounded.svbrdf.size, (Size{333, 100})) << "rounding to whole texels is no difference";
}

TEST(Resolving, RefusesAHeightMapInThePlaceOfNormals) {
  SlotMap relief = image({4, 4}, {0.2f, 0.2f, 0.2f}, "bump.png");
  for (Layer& layer : relief.image.layers) layer.plane.at(1, 1) = 0.7f;
  try {
    resolve({{Slot::Normal, relief}}, {});
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::Input);
    EXPECT_THAT(error.what(), HasSubstr("bump.png"));
    EXPECT_THAT(error.what(), HasSubstr("height map in the place of normals"));
  }
}

TEST(Resolving, IsUntouchedByMapsThatNothingReads) {
  const SlotMaps read = {{Slot::BaseColor, image({4, 4}, {0.5f, 0.4f, 0.3f})}};
  SlotMaps more = read;
  const float nan = std::numeric_limits<float>::quiet_NaN();
  more[Slot::Height] = image({64, 64}, {nan});
  more[Slot::Emissive] = image({32, 32}, {9, 9, 9});
  more[Slot::Opacity] = image({32, 16}, {-1});
  more[Slot::SpecularColor] = image({32, 32}, {nan, nan, nan});
  const Resolved plain = resolve(read, {});
  const Resolved full = resolve(more, {});
  EXPECT_EQ(full.svbrdf.size, plain.svbrdf.size);
  EXPECT_EQ(texel(full.svbrdf.diffuse_color, 3, 3), texel(plain.svbrdf.diffuse_color, 3, 3));
  EXPECT_TRUE(full.warnings.empty());
  EXPECT_THAT(full.notes, Contains("emissive: not rendered, ignored"));
  EXPECT_THAT(full.notes, Contains("opacity: not rendered, ignored"));
  EXPECT_THAT(full.notes, Contains(HasSubstr("height: not displaced")));
  EXPECT_THAT(full.notes, Contains("specular_color: not read by metal-rough"));
}

TEST(Resolving, ClampsToItsRangeAndCounts) {
  SlotMap rough = image({4, 1}, {0.5f});
  rough.image.layers[0].plane.at(1, 0) = -0.2f;
  rough.image.layers[0].plane.at(2, 0) = 1.7f;
  rough.image.layers[0].plane.at(3, 0) = 1.00001f;
  const Resolved resolved = resolve({{Slot::Roughness, rough}}, {});
  EXPECT_EQ(resolved.svbrdf.roughness.at(1, 0), 0);
  EXPECT_EQ(resolved.svbrdf.roughness.at(2, 0), 1);
  EXPECT_EQ(resolved.svbrdf.roughness.at(3, 0), 1);
  EXPECT_THAT(resolved.warnings, Contains("roughness: 2 values clamped to [0, 1]"));
}

TEST(Resolving, ReplacesUnreadableValuesByTheSlotsConstantAndCounts) {
  SlotMap metal = image({4, 1}, {1.0f});
  metal.image.layers[0].plane.at(1, 0) = std::numeric_limits<float>::quiet_NaN();
  metal.image.layers[0].plane.at(2, 0) = std::numeric_limits<float>::infinity();
  const Resolved resolved =
      resolve({{Slot::BaseColor, constant(0.5f)}, {Slot::Metallic, metal}}, {});
  EXPECT_NEAR(resolved.svbrdf.diffuse_color[0].at(1, 0), 0.5f, 1e-6);
  EXPECT_NEAR(resolved.svbrdf.diffuse_color[0].at(2, 0), 0.5f, 1e-6);
  EXPECT_THAT(resolved.warnings, Contains("metallic: 2 values are NaN or Inf, replaced by 0"));
}

TEST(Resolving, TellsHowManyNormalsAreNotUnitAndHowManyHaveNoDirection) {
  SlotMap normal = image({20, 10}, {0.5f, 0.5f, 1.0f});
  normal.convention = NormalConvention::OpenGl;
  normal.image.layers[2].plane.at(3, 3) = 0.9f;
  normal.image.layers[2].plane.at(4, 3) = 0.95f;
  normal.image.layers[2].plane.at(5, 3) = 0.5f;
  const Resolved resolved = resolve({{Slot::Normal, normal}}, {});
  EXPECT_THAT(resolved.notes, Contains("normal: 2 (1 %) are longer or shorter than 1 by more than "
                                       "0.012, made unit"));
  EXPECT_THAT(resolved.notes, Contains("normal: 1 (0.5 %) without direction, made flat"));
  EXPECT_EQ(resolved.svbrdf.normal[2].at(3, 3), 1.0f);
}

TEST(Resolving, SpreadsAGreyImageOverTheChannelsOfAColour) {
  const Resolved resolved = resolve({{Slot::BaseColor, image({2, 2}, {0.3f})}}, {});
  expect_near(texel(resolved.svbrdf.diffuse_color), {0.3f, 0.3f, 0.3f});
}

TEST(Resolving, TakesTheStatedConventionBeforeTheNameBeforeTheHeightMap) {
  SlotMap normal = image({2, 2}, {0.5f, 0.7f, 0.9f});
  const auto y_of = [&](const SlotMap& map, const WorkflowSettings& settings) {
    return resolve({{Slot::Normal, map}}, settings).svbrdf.normal[1].at(0, 0);
  };
  EXPECT_GT(y_of(normal, {}), 0);
  normal.convention = NormalConvention::DirectX;
  EXPECT_LT(y_of(normal, {}), 0);
  EXPECT_GT(y_of(normal, {.normal = NormalConvention::OpenGl}), 0);
}

TEST(Resolving, WarnsWhereNothingTellsTheConvention) {
  const SlotMaps maps = {{Slot::Normal, image({2, 2}, {0.5f, 0.7f, 0.9f})}};
  EXPECT_THAT(resolve(maps, {}).warnings, Contains(HasSubstr("read as OpenGL")));
  EXPECT_TRUE(resolve(maps, {.normal = NormalConvention::DirectX}).warnings.empty());
}

TEST(Resolving, RefusesAMapWithoutTexelsAndANormalMapOfOneChannel) {
  EXPECT_THROW(resolve({{Slot::Roughness, SlotMap{}}}, {}), Error);
  try {
    resolve({{Slot::Normal, image({2, 2}, {0.5f}, "n.png")}}, {});
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::Input);
    EXPECT_THAT(error.what(), HasSubstr("n.png"));
  }
}

TEST(Resolving, FillsEveryPlaneOfEveryWorkflowAtOneSize) {
  for (size_t i = 0; i < workflow_names.size(); ++i) {
    const Resolved resolved =
        resolve({{Slot::Roughness, image({5, 3}, {0.5f})}}, {.workflow = static_cast<Workflow>(i)});
    const Svbrdf& svbrdf = resolved.svbrdf;
    for (const auto* planes : {&svbrdf.diffuse_color, &svbrdf.f0, &svbrdf.normal}) {
      for (const Plane& plane : *planes) EXPECT_EQ(plane.size(), (Size{5, 3}));
    }
    EXPECT_EQ(svbrdf.ambient_occlusion.size(), (Size{5, 3}));
    EXPECT_EQ(svbrdf.size, (Size{5, 3}));
  }
}

}  // namespace
}  // namespace kiln

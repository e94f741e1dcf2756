// SPDX-License-Identifier: Apache-2.0
#include "kiln/color/color.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>
#include <tuple>

#include "kiln/core/error.h"
#include "support/faults.h"
#include "support/places.h"
#include "support/real_data.h"

namespace kiln {
namespace {

using test::fault_text;

using testing::ElementsAre;
using testing::HasSubstr;

constexpr float nan_value = std::numeric_limits<float>::quiet_NaN();
constexpr float inf_value = std::numeric_limits<float>::infinity();

// The closed forms of IEC 61966-2-1, in double.
double srgb_decode(double v) {
  return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}
double srgb_encode(double v) {
  return v <= 0.0031308 ? v * 12.92 : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
}

Layers texel(float r, float g, float b) {
  Layers image = make_layers({1, 1}, {"R", "G", "B"});
  image.layers[0].plane.at(0, 0) = r;
  image.layers[1].plane.at(0, 0) = g;
  image.layers[2].plane.at(0, 0) = b;
  return image;
}

float channel(const Layers& image, const std::string& name, int x = 0, int y = 0) {
  return image.find(name)->at(x, y);
}

// A ramp over every channel, many rows high.
Layers ramp(Size size, double from, double to) {
  Layers image = make_layers(size, {"R", "G", "B"});
  const double last = static_cast<double>(area(size)) - 1;
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const double t = (y * size.width + x) / last;
      for (Layer& layer : image.layers) {
        layer.plane.at(x, y) = static_cast<float>(from + (to - from) * t);
      }
    }
  }
  return image;
}

TEST(BuiltinColorConfig, IsTheShippedFileWordForWord) {
  std::ifstream file(test::source_folder() / "textures/kiln.ocio", std::ios::binary);
  const std::string shipped((std::istreambuf_iterator<char>(file)), {});
  EXPECT_FALSE(shipped.empty());
  EXPECT_EQ(builtin_color_config(), shipped);
}

TEST(BuiltinColorConfig, ListsItsSpacesInOrder) {
  const ColorConfig config;
  EXPECT_EQ(config.source(), "builtin");
  EXPECT_THAT(config.color_spaces(),
              ElementsAre("lin_rec709_scene", "srgb_rec709_scene", "g22_rec709_scene",
                          "lin_ap1_scene", "lin_ap0_scene", "data"));
}

TEST(BuiltinColorConfig, ShowsUnToneMappedSrgbByDefault) {
  const ColorConfig config;
  EXPECT_THAT(config.displays(), ElementsAre("sRGB"));
  EXPECT_THAT(config.views("sRGB"), ElementsAre("Un-tone-mapped", "ACES 1.0 SDR-video"));
  EXPECT_EQ(config.default_display(), "sRGB");
  EXPECT_EQ(config.default_view("sRGB"), "Un-tone-mapped");
}

TEST(ColorConfig, ResolvesNamesAliasesAndRoles) {
  const ColorConfig config;
  EXPECT_EQ(config.resolve("lin_rec709_scene"), "lin_rec709_scene");
  EXPECT_EQ(config.resolve("LIN_REC709_SCENE"), "lin_rec709_scene");
  EXPECT_EQ(config.resolve("lin_srgb"), "lin_rec709_scene");
  EXPECT_EQ(config.resolve("Linear Rec.709 (sRGB)"), "lin_rec709_scene");
  EXPECT_EQ(config.resolve("scene_linear"), "lin_rec709_scene");
  EXPECT_EQ(config.resolve("sRGB"), "srgb_rec709_scene");
  EXPECT_EQ(config.resolve("srgb_texture"), "srgb_rec709_scene");
  EXPECT_EQ(config.resolve("sRGB - Texture"), "srgb_rec709_scene");
  EXPECT_EQ(config.resolve("ACEScg"), "lin_ap1_scene");
  EXPECT_EQ(config.resolve("ACES2065-1"), "lin_ap0_scene");
  EXPECT_EQ(config.resolve("raw"), "data");
}

TEST(ColorConfig, KnowsDataFromColour) {
  const ColorConfig config;
  EXPECT_TRUE(config.is_data("data"));
  EXPECT_TRUE(config.is_data("raw"));
  EXPECT_FALSE(config.is_data("srgb_texture"));
}

TEST(ColorConfig, NamesTheNearestSpaceWhenOneIsUnknown) {
  const ColorConfig config;
  EXPECT_THAT(fault_text(Fault::Usage, [&] { config.resolve("srgb_textur"); }),
              HasSubstr("unknown colour space 'srgb_textur' (did you mean 'srgb_texture'?)"));
  EXPECT_THAT(fault_text(Fault::Usage, [&] { config.resolve("ACESgc"); }), HasSubstr("'ACEScg'"));
  EXPECT_THAT(fault_text(Fault::Usage, [&] { config.resolve("xyzzy_quux_plugh"); }),
              HasSubstr("known: lin_rec709_scene"));
}

TEST(ColorConfig, RefusesBareLinearAndSpellsOutWhatItLacks) {
  const ColorConfig config;
  for (const std::string name : {"linear", "Linear"}) {
    const std::string text = fault_text(Fault::Usage, [&] { config.resolve(name); });
    EXPECT_THAT(text, HasSubstr("primaries"));
    EXPECT_THAT(text, HasSubstr("lin_rec709_scene"));
  }
}

TEST(ColorConfig, DecodesSrgbLikeTheClosedForm) {
  const ColorConfig config;
  const Layers encoded = ramp({256, 257}, 0, 1);
  Layers image = encoded;
  config.convert(image, "srgb_texture", "lin_rec709_scene");
  double worst = 0;
  for (const char* name : {"R", "G", "B"}) {
    for (int y = 0; y < 257; ++y) {
      for (int x = 0; x < 256; ++x) {
        const double expected = srgb_decode(channel(encoded, name, x, y));
        worst = std::max(worst, std::abs(channel(image, name, x, y) - expected));
      }
    }
  }
  EXPECT_LE(worst, 1e-6);
}

// OpenColorIO lets the two pieces of the curve meet without a kink (slope 12.9232, not 12.92):
// below 0.0031 that moves the encoded value by up to 1e-5.
TEST(ColorConfig, EncodesSrgbLikeTheClosedForm) {
  const ColorConfig config;
  const Layers linear = ramp({256, 33}, 0, 1);
  Layers image = linear;
  config.convert(image, "lin_rec709_scene", "srgb_texture");
  for (int y = 0; y < 33; ++y) {
    for (int x = 0; x < 256; ++x) {
      ASSERT_NEAR(channel(image, "G", x, y), srgb_encode(channel(linear, "G", x, y)), 1e-5);
    }
  }
}

TEST(ColorConfig, DecodesAPurePowerWhereTheSpaceSaysSo) {
  const ColorConfig config;
  Layers image = texel(0.5f, 0.25f, 1.0f);
  config.convert(image, "g22_rec709_scene", "lin_rec709_scene");
  EXPECT_NEAR(channel(image, "R"), std::pow(0.5, 2.2), 1e-6);
  EXPECT_NEAR(channel(image, "G"), std::pow(0.25, 2.2), 1e-6);
  EXPECT_NEAR(channel(image, "B"), 1.0, 1e-6);
}

TEST(ColorConfig, ComesBackAfterARoundTripThroughEverySpace) {
  const ColorConfig config;
  for (const std::string& space : config.color_spaces()) {
    if (config.is_data(space)) continue;
    Layers image = texel(0.7f, 0.2f, 0.05f);
    config.convert(image, "lin_rec709_scene", space);
    config.convert(image, space, "lin_rec709_scene");
    EXPECT_NEAR(channel(image, "R"), 0.7f, 2e-6) << space;
    EXPECT_NEAR(channel(image, "G"), 0.2f, 2e-6) << space;
    EXPECT_NEAR(channel(image, "B"), 0.05f, 2e-6) << space;
  }
}

TEST(ColorConfig, KeepsWhiteWhiteBetweenPrimaries) {
  const ColorConfig config;
  for (const char* space : {"ACEScg", "ACES2065-1", "srgb_texture"}) {
    Layers image = texel(1, 1, 1);
    config.convert(image, "lin_rec709_scene", space);
    for (const char* name : {"R", "G", "B"}) EXPECT_NEAR(channel(image, name), 1.0, 2e-6) << space;
  }
}

// Rec.709 -> AP1 through Bradford from D65 to the ACES white, first column, from the chromaticities
// of ITU-R BT.709 and Academy S-2014-004.
TEST(ColorConfig, MovesRedBetweenPrimariesByTheKnownMatrix) {
  const ColorConfig config;
  Layers image = texel(1, 0, 0);
  config.convert(image, "lin_rec709_scene", "ACEScg");
  EXPECT_NEAR(channel(image, "R"), 0.6130974, 1e-5);
  EXPECT_NEAR(channel(image, "G"), 0.0701937, 1e-5);
  EXPECT_NEAR(channel(image, "B"), 0.0206156, 1e-5);
}

TEST(ColorConfig, KnowsWhetherChannelsDependOnEachOther) {
  const ColorConfig config;
  EXPECT_TRUE(config.converts_each_alone("srgb_rec709_scene", "lin_rec709_scene"));
  EXPECT_FALSE(config.converts_each_alone("srgb_rec709_scene", "lin_ap1_scene"));
  EXPECT_FALSE(config.converts_each_alone("lin_rec709_scene", "lin_rec709_scene"));
}

TEST(ColorConfig, ChangesNoBitFromASpaceToItself) {
  const ColorConfig config;
  const Layers before = ramp({61, 7}, -3, 70000);
  Layers after = before;
  config.convert(after, "lin_srgb", "lin_rec709_scene");
  for (size_t c = 0; c < 3; ++c) {
    for (int y = 0; y < 7; ++y) {
      const auto a = before.layers[c].plane.texels_of_row(y);
      EXPECT_EQ(std::memcmp(a.data(), after.layers[c].plane.row(y), a.size_bytes()), 0);
    }
  }
}

TEST(ColorConfig, LeavesAllPlanesButColourAlone) {
  const ColorConfig config;
  Layers image = texel(0.5f, 0.5f, 0.5f);
  image.add("A", 0.5f);
  image.add("stderr.R", 0.5f);
  config.convert(image, "srgb_texture", "lin_rec709_scene");
  EXPECT_EQ(channel(image, "A"), 0.5f);
  EXPECT_EQ(channel(image, "stderr.R"), 0.5f);
  EXPECT_LT(channel(image, "R"), 0.22f);
}

TEST(ColorConfig, ConvertsAGreyImageAsNeutral) {
  const ColorConfig config;
  Layers image = make_layers({1, 1}, {"Y"});
  image.layers[0].plane.at(0, 0) = 0.5f;
  config.convert(image, "srgb_texture", "lin_rec709_scene");
  EXPECT_NEAR(channel(image, "Y"), srgb_decode(0.5), 1e-6);
}

TEST(ColorConfig, KeepsNanAndWhatLiesBeyondOne) {
  const ColorConfig config;
  Layers image = texel(nan_value, 0.5f, 4.0f);
  config.convert(image, "srgb_texture", "lin_rec709_scene");
  EXPECT_TRUE(std::isnan(channel(image, "R")));
  Layers bright = texel(4.0f, 4.0f, 4.0f);
  config.convert(bright, "srgb_texture", "lin_rec709_scene");
  EXPECT_NEAR(channel(bright, "G") / srgb_decode(4.0), 1, 2e-6);
  Layers negative = texel(-0.5f, -0.5f, -0.5f);
  config.convert(negative, "lin_rec709_scene", "ACEScg");
  EXPECT_NEAR(channel(negative, "B"), -0.5, 1e-6);
}

TEST(ColorConfig, RefusesToConvertData) {
  const ColorConfig config;
  Layers image = texel(0, 0, 0);
  EXPECT_THAT(fault_text(Fault::Usage, [&] { config.convert(image, "raw", "ACEScg"); }),
              HasSubstr("'data' holds data"));
  EXPECT_THAT(fault_text(Fault::Usage, [&] { config.convert(image, "ACEScg", "data"); }),
              HasSubstr("'data' holds data"));
}

TEST(ColorConfig, RefusesAnImageWithoutColour) {
  const ColorConfig config;
  Layers image = make_layers({1, 1}, {"roughness"});
  EXPECT_THAT(fault_text(Fault::Usage, [&] { config.convert(image, "sRGB", "ACEScg"); }),
              HasSubstr("expected channels R, G, B or Y"));
}

TEST(DisplayView, UnToneMappedIsTheSrgbCurveAndNoMore) {
  const ColorConfig config;
  for (const float v : {0.0f, 0.001f, 0.18f, 0.5f, 1.0f}) {
    const Layers shown = config.to_display(texel(v, v, v), "lin_rec709_scene", {});
    for (const char* name : {"R", "G", "B"}) {
      EXPECT_NEAR(channel(shown, name), srgb_encode(v), 1e-5) << v;
    }
  }
  const Layers colored = config.to_display(texel(0.8f, 0.3f, 0.05f), "lin_rec709_scene", {});
  EXPECT_NEAR(channel(colored, "R"), srgb_encode(0.8), 1e-5);
  EXPECT_NEAR(channel(colored, "G"), srgb_encode(0.3), 1e-5);
  EXPECT_NEAR(channel(colored, "B"), srgb_encode(0.05), 1e-5);
}

TEST(DisplayView, ShowsTheSameColourFromAnyWorkingSpace) {
  const ColorConfig config;
  Layers image = texel(0.8f, 0.3f, 0.05f);
  const Layers from_rec709 = config.to_display(image, "lin_rec709_scene", {});
  config.convert(image, "lin_rec709_scene", "ACEScg");
  const Layers from_ap1 = config.to_display(image, "ACEScg", {});
  for (const char* name : {"R", "G", "B"}) {
    EXPECT_NEAR(channel(from_rec709, name), channel(from_ap1, name), 1e-5);
  }
}

TEST(DisplayView, AcesIsDarkerAtMidGreyAndRisesEverywhere) {
  const ColorConfig config;
  const ColorConfig::Display aces{.view = "ACES 1.0 SDR-video"};
  const float grey =
      channel(config.to_display(texel(0.18f, 0.18f, 0.18f), "lin_rec709_scene", aces), "G");
  EXPECT_GT(grey, 0.3f);
  EXPECT_LT(grey, srgb_encode(0.18));
  float last = -1;
  for (int i = -40; i <= 24; ++i) {
    const float v = 0.18f * std::exp2(static_cast<float>(i) / 4);
    const float now = channel(config.to_display(texel(v, v, v), "lin_rec709_scene", aces), "G");
    EXPECT_GE(now, last) << v;
    last = now;
  }
  EXPECT_GT(last, 0.95f);
}

TEST(DisplayView, AppliesExposureInTheWorkingSpace) {
  const ColorConfig config;
  const Layers brighter =
      config.to_display(texel(0.1f, 0.1f, 0.1f), "lin_rec709_scene", {.exposure = 1.5});
  EXPECT_NEAR(channel(brighter, "G"), srgb_encode(0.1 * std::exp2(1.5)), 1e-5);
}

TEST(DisplayView, ClampsAndHasNoNan) {
  const ColorConfig config;
  for (const std::string& view : config.views("sRGB")) {
    const ColorConfig::Display display{.view = view};
    const Layers sun = config.to_display(texel(inf_value, inf_value, inf_value), "ACEScg", display);
    const Layers hole =
        config.to_display(texel(nan_value, nan_value, nan_value), "ACEScg", display);
    const Layers below = config.to_display(texel(-1, -1, -1), "ACEScg", display);
    for (const char* name : {"R", "G", "B"}) {
      EXPECT_NEAR(channel(sun, name), 1.0f, 0.05f) << view;
      EXPECT_EQ(channel(hole, name), 0.0f) << view;
      EXPECT_NEAR(channel(below, name), 0.0f, 1e-3) << view;
    }
  }
}

TEST(DisplayView, KeepsAlphaAndLeavesOtherLayersOut) {
  const ColorConfig config;
  Layers image = texel(0.5f, 0.5f, 0.5f);
  image.add("A", 0.25f);
  image.add("stderr.R", 1);
  const Layers shown = config.to_display(image, "lin_rec709_scene", {});
  EXPECT_EQ(shown.layers.size(), 4u);
  EXPECT_EQ(channel(shown, "A"), 0.25f);
  EXPECT_EQ(shown.find("stderr.R"), nullptr);
}

TEST(DisplayView, NamesTheNearestWhenOneIsUnknown) {
  const ColorConfig config;
  const Layers image = texel(0, 0, 0);
  EXPECT_THAT(
      fault_text(Fault::Usage, [&] { config.to_display(image, "ACEScg", {.display = "sRGBB"}); }),
      HasSubstr("did you mean 'sRGB'?"));
  EXPECT_THAT(fault_text(Fault::Usage,
                         [&] { config.to_display(image, "ACEScg", {.view = "Untonemapped"}); }),
              HasSubstr("did you mean 'Un-tone-mapped'?"));
}

TEST(ColorConfig, RefusesAMissingOrBrokenConfigByName) {
  EXPECT_THAT(fault_text(Fault::Input, [] { ColorConfig("/no/such.ocio"); }),
              HasSubstr("/no/such.ocio: no such file"));
  EXPECT_THAT(fault_text(Fault::Input, [] { ColorConfig("/"); }), HasSubstr("is a folder"));
  const std::string broken = testing::TempDir() + "kiln_broken.ocio";
  std::ofstream(broken) << "ocio_profile_version: 2.1\nroles: [\n";
  EXPECT_THAT(fault_text(Fault::Input, [&] { ColorConfig{broken}; }), HasSubstr(broken));
  std::remove(broken.c_str());
}

TEST(ColorConfig, RefusesAProfileThatIsTooNewAndSaysSo) {
  KILN_REQUIRE_REAL_DATA(data);
  const std::string path = data / "data/ocio/cg-config-v2.1.0_aces-v1.3_ocio-v2.3.ocio";
  testing::internal::CaptureStderr();
  const std::string text = fault_text(Fault::Input, [&] { ColorConfig{path}; });
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_THAT(text, HasSubstr("2.3"));
  EXPECT_THAT(text, HasSubstr("cannot be read by OpenColorIO 2."));
}

TEST(ColorConfig, AgreesWithThePublishedAcesConfigs) {
  KILN_REQUIRE_REAL_DATA(data);
  const ColorConfig ours;
  for (const char* name : {"cg-config-v1.0.0_aces-v1.3_ocio-v2.1.ocio",
                           "studio-config-v1.0.0_aces-v1.3_ocio-v2.1.ocio"}) {
    const ColorConfig theirs(data / "data/ocio" / name);
    for (const auto& [from, to] :
         {std::tuple{"sRGB - Texture", "ACEScg"}, std::tuple{"ACEScg", "Linear Rec.709 (sRGB)"},
          std::tuple{"Linear Rec.709 (sRGB)", "ACES2065-1"}}) {
      Layers a = texel(0.7f, 0.2f, 0.05f);
      Layers b = a;
      ours.convert(a, from, to);
      theirs.convert(b, from, to);
      for (const char* c : {"R", "G", "B"}) {
        EXPECT_NEAR(channel(a, c), channel(b, c), 2e-6) << name << " " << from << " " << to;
      }
    }
    const Layers a =
        ours.to_display(texel(0.7f, 0.2f, 0.05f), "ACEScg", {.view = "ACES 1.0 SDR-video"});
    const Layers b =
        theirs.to_display(texel(0.7f, 0.2f, 0.05f), "ACEScg",
                          {.display = "sRGB - Display", .view = "ACES 1.0 - SDR Video"});
    for (const char* c : {"R", "G", "B"}) EXPECT_NEAR(channel(a, c), channel(b, c), 1e-5) << name;
  }
}

}  // namespace
}  // namespace kiln

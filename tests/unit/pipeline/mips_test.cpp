// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "kiln/io/texture_file.h"
#include "kiln/math/hash.h"
#include "kiln/pipeline/run.h"
#include "support/images.h"
#include "support/workshop.h"

namespace kiln {
namespace {

namespace fs = std::filesystem;

using test::greatest_difference;
using test::text_of;
using test::Workshop;
using testing::ElementsAre;
using testing::HasSubstr;

// A set of three maps of hashed bytes.
void paint_stones(const Workshop& shop) {
  const auto paint = [&](const std::string& name, const std::vector<std::string>& names,
                         uint32_t seed) {
    Layers image = make_layers({48, 20}, names);
    for (Layer& layer : image.layers) {
      ++seed;
      for (int y = 0; y < 20; ++y) {
        for (int x = 0; x < 48; ++x) {
          const uint32_t bits = combine_hash(seed, static_cast<uint32_t>(y * 48 + x));
          layer.plane.at(x, y) = static_cast<float>(bits % 256) / 255.0f;
        }
      }
    }
    fs::create_directories(shop / "stones");
    write_image(shop / ("stones/" + name), image, {PixelType::Uint8, {}});
  };
  paint("stones_BaseColor.png", {"R", "G", "B"}, 1);
  paint("stones_Roughness.png", {"Y"}, 5);
  Layers normal = make_layers({48, 20}, {"R", "G", "B"});
  for (int y = 0; y < 20; ++y) {
    for (int x = 0; x < 48; ++x) {
      normal.layers[0].plane.at(x, y) = static_cast<float>(108 + 5 * ((x * 7 + y) % 9)) / 255.0f;
      normal.layers[1].plane.at(x, y) = static_cast<float>(108 + 5 * ((x + y * 5) % 9)) / 255.0f;
      normal.layers[2].plane.at(x, y) = 250.0f / 255;
    }
  }
  write_image(shop / "stones/stones_NormalGL.png", normal, {PixelType::Uint8, {}});
}

Report run(const Workshop& shop, const std::string& settings, const std::string& out = "out") {
  const std::string text =
      "version: 1\nsets: [{ path: stones }]\nbakes:\n  - { bake: mips, " + settings + " }\n";
  return run_plan(make_plan(read_pipeline(shop.write("p.yaml", text)), shop / out), Records::Keep);
}

std::string failure_of(const Report& report) {
  return report.tasks.at(0).fault ? report.tasks.at(0).fault->what() : "";
}

Layers image_of(const fs::path& path) { return read_image(path).image; }

TEST(MipFiles, OfOneMapAreTheOneFileThatIsNamed) {
  const Workshop shop;
  paint_stones(shop);
  const Report report = run(shop, "map: roughness, out: \"{set}/roughness_mips.exr\"");
  ASSERT_EQ(failure_of(report), "");
  EXPECT_THAT(report.tasks[0].outputs, ElementsAre("stones/roughness_mips.exr"));
  const TextureFile file = read_texture(shop / "out/stones/roughness_mips.exr");
  EXPECT_EQ(file.texture.levels.size(), 6u);
  EXPECT_EQ(file.stored, PixelType::Half);
  EXPECT_LE(greatest_difference(file.texture.levels[0][0],
                                image_of(shop / "stones/stones_Roughness.png")),
            5e-4);
  EXPECT_FALSE(report.tasks[0].figures.empty());
}

TEST(MipFiles, AreAFolderOfTexturesInEveryContainer) {
  const Workshop shop;
  paint_stones(shop);
  for (const std::string format : {"exr", "tif", "tx", "dds", "ktx2"}) {
    ASSERT_EQ(failure_of(run(shop, "format: " + format + ", out: \"{set}\"")), "") << format;
    for (const char* map : {"base_color", "normal", "roughness"}) {
      const fs::path path = shop / ("out/stones/" + std::string(map) + "." + format);
      ASSERT_TRUE(fs::exists(path)) << path;
      const TextureFile file = read_texture(path);
      EXPECT_EQ(file.facts.size, (Size{48, 20}));
      const bool has_directories = format == "tif" || format == "tx";
      EXPECT_EQ(file.texture.levels.size(), has_directories ? 1u : 6u) << path;
      EXPECT_EQ(file.facts.type, format == "exr" ? PixelType::Half : PixelType::Uint8) << path;
    }
  }
  EXPECT_EQ(read_texture(shop / "out/stones/base_color.ktx2").facts.color_space_tag,
            "srgb_rec709_scene");
  EXPECT_NE(read_texture(shop / "out/stones/roughness.ktx2").facts.color_space_tag,
            "srgb_rec709_scene");
}

TEST(MipFiles, KeepTheBitsOfTheFirstLevel) {
  const Workshop shop;
  paint_stones(shop);
  ASSERT_EQ(failure_of(run(shop, "format: files, out: \"{set}\"")), "");
  for (const auto& [name, source] :
       {std::pair{"base_color", "BaseColor"}, {"normal", "NormalGL"}, {"roughness", "Roughness"}}) {
    const Layers first = image_of(shop / ("out/stones/" + std::string(name) + "_0.png"));
    EXPECT_EQ(greatest_difference(
                  first, image_of(shop / ("stones/stones_" + std::string(source) + ".png"))),
              0)
        << name;
    EXPECT_EQ(image_of(shop / ("out/stones/" + std::string(name) + "_5.png")).size, (Size{1, 1}));
  }
}

TEST(MipFiles, FilterColourInLinearLight) {
  const Workshop shop;
  Layers checker = make_layers({2, 2}, {"R", "G", "B"});
  for (Layer& layer : checker.layers) layer.plane.at(0, 0) = layer.plane.at(1, 1) = 1;
  fs::create_directories(shop / "stones");
  write_image(shop / "stones/stones_BaseColor.png", checker, {PixelType::Uint8, {}});
  ASSERT_EQ(failure_of(run(shop, "map: base_color, out: \"{set}/c.png\"")), "");
  const Layers grey = image_of(shop / "out/stones/c_1.png");
  EXPECT_NEAR(grey.layers[0].plane.at(0, 0), 188.0f / 255, 1e-6);  // half the light
}

TEST(MipFiles, AreTheSameBytesEachTime) {
  const Workshop shop;
  paint_stones(shop);
  for (const std::string format : {"exr", "tif", "ktx2"}) {
    const std::string settings = "format: " + format + ", out: m";
    ASSERT_EQ(failure_of(run(shop, settings, "one")), "");
    ASSERT_EQ(failure_of(run(shop, settings, "two")), "");
    for (const char* map : {"base_color", "normal", "roughness"}) {
      const std::string name = "m/" + std::string(map) + "." + format;
      EXPECT_TRUE(text_of(shop / "one" / name) == text_of(shop / "two" / name)) << name;
    }
  }
}

TEST(MipFiles, OfACutoutSayWhatWouldKeepItsCoverage) {
  const Workshop shop;
  paint_stones(shop);
  fs::copy(shop / "stones/stones_Roughness.png", shop / "stones/stones_Opacity.png");
  const std::string text =
      "version: 1\nsets: [{ path: stones, alpha_cutoff: 0.25 }]\n"
      "bakes: [{ bake: mips, map: opacity, out: m.exr }]\n";
  const Plan plan = make_plan(read_pipeline(shop.write("p.yaml", text)), shop / "out");
  EXPECT_THAT(run_plan(plan, Records::None).tasks.at(0).notes,
              testing::Contains("the set is a cutout: alpha_test 0.25 would keep its coverage"));
}

TEST(MipFiles, SayWhatDoesNotFit) {
  const Workshop shop;
  paint_stones(shop);
  EXPECT_THAT(failure_of(run(shop, "out: m.exr")), HasSubstr("expected a folder, or {suffix}"));
  EXPECT_THAT(failure_of(run(shop, "map: roughness, format: dds, out: m.exr")),
              HasSubstr("format: found dds"));
  EXPECT_FALSE(fs::exists(shop / "out/m.exr"));
}

}  // namespace
}  // namespace kiln

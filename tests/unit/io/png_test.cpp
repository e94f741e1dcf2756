// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "crafted_files.h"
#include "image_folder.h"

namespace kiln {
namespace {

using namespace test;
using testing::ElementsAre;
using testing::HasSubstr;

class Png : public ImageFolder {
 protected:
  ImageFile read(const CraftedPng& image) const {
    return read_image(write_bytes("crafted.png", png(image)));
  }
};

constexpr float byte(int value) { return static_cast<float>(value) / 255.0f; }

TEST_F(Png, NeverMultipliesColourByAlpha) {
  const ImageFile file = read(
      {.width = 2, .color_type = 6, .rows = {std::string("\xc8\x64\x32\x80\xc8\x64\x32\x00", 8)}});
  EXPECT_THAT(channel_names(file.image), ElementsAre("R", "G", "B", "A"));
  for (int x = 0; x < 2; ++x) {
    EXPECT_EQ(file.image.find("R")->at(x, 0), byte(200));
    EXPECT_EQ(file.image.find("G")->at(x, 0), byte(100));
    EXPECT_EQ(file.image.find("B")->at(x, 0), byte(50));
  }
  EXPECT_EQ(file.image.find("A")->at(0, 0), byte(128));
  EXPECT_EQ(file.image.find("A")->at(1, 0), 0.0f);
}

TEST_F(Png, WritesColourUnderAnyAlphaAsItIs) {
  const ImageFile before = read(
      {.width = 2, .color_type = 6, .rows = {std::string("\xc8\x64\x32\x80\xc8\x64\x32\x00", 8)}});
  write_image(folder / "a.png", before.image, {.type = PixelType::Uint8});
  const ImageFile after = read_image(folder / "a.png");
  for (size_t c = 0; c < 4; ++c) {
    for (int x = 0; x < 2; ++x) {
      EXPECT_EQ(after.image.layers[c].plane.at(x, 0), before.image.layers[c].plane.at(x, 0));
    }
  }
}

TEST_F(Png, ReadsGreyWithAlpha) {
  const ImageFile file = read({.color_type = 4, .rows = {std::string("\x40\x20", 2)}});
  EXPECT_THAT(channel_names(file.image), ElementsAre("Y", "A"));
  EXPECT_EQ(file.image.layers[0].plane.at(0, 0), byte(64));
  EXPECT_EQ(file.image.layers[1].plane.at(0, 0), byte(32));
}

TEST_F(Png, ReadsOneChannelOf8And16And1Bit) {
  EXPECT_EQ(read({.rows = {"\x80"}}).image.layers[0].plane.at(0, 0), byte(128));
  const ImageFile deep = read({.depth = 16, .rows = {"\x12\x34"}});
  EXPECT_EQ(deep.facts.type, PixelType::Uint16);
  EXPECT_EQ(deep.image.layers[0].plane.at(0, 0), static_cast<float>(0x1234) / 65535.0f);
  const ImageFile bits = read({.width = 8, .depth = 1, .rows = {"\xa5"}});
  EXPECT_THAT(bits.image.layers[0].plane.texels_of_row(0), ElementsAre(1, 0, 1, 0, 0, 1, 0, 1));
}

TEST_F(Png, ReadsAPalette) {
  const ImageFile file = read({.width = 2,
                               .color_type = 3,
                               .before_pixels = png_chunk("PLTE", "\x10\x20\x30\x40\x50\x60"),
                               .rows = {std::string("\x01\x00", 2)}});
  EXPECT_THAT(channel_names(file.image), ElementsAre("R", "G", "B"));
  EXPECT_EQ(file.image.find("G")->at(0, 0), byte(0x50));
  EXPECT_EQ(file.image.find("B")->at(1, 0), byte(0x30));
}

TEST_F(Png, ReadsAPaletteWithTransparency) {
  const ImageFile file = read({.width = 2,
                               .color_type = 3,
                               .before_pixels = png_chunk("PLTE", "\x10\x20\x30\x40\x50\x60") +
                                                png_chunk("tRNS", std::string("\x00\x80", 2)),
                               .rows = {std::string("\x00\x01", 2)}});
  EXPECT_THAT(channel_names(file.image), ElementsAre("R", "G", "B", "A"));
  EXPECT_EQ(file.image.find("R")->at(0, 0), byte(0x10));
  EXPECT_EQ(file.image.find("A")->at(0, 0), 0);
  EXPECT_EQ(file.image.find("R")->at(1, 0), byte(0x40));
  EXPECT_EQ(file.image.find("A")->at(1, 0), byte(0x80));
}

TEST_F(Png, TakesTheColourTagFromTheFileAndNotFromCustom) {
  const auto tag = [&](const std::string& chunks) {
    return read({.before_pixels = chunks, .rows = {"x"}}).facts.color_space_tag;
  };
  EXPECT_EQ(tag(""), std::nullopt);
  EXPECT_EQ(tag(png_chunk("sRGB", std::string(1, '\0'))), "srgb_rec709_scene");
  EXPECT_EQ(tag(png_chunk("gAMA", big_endian(100000, 4))), "lin_rec709_scene");
  EXPECT_EQ(tag(png_chunk("gAMA", big_endian(45455, 4))), "g22_rec709_scene");
  EXPECT_EQ(tag(png_chunk("gAMA", big_endian(77777, 4))), std::nullopt);
}

TEST_F(Png, SaysWhatItsColoursAreOnlyWhenAsked) {
  const Layers image = pattern({4, 4}, {"R", "G", "B"});
  const auto tag = [&](ColorTag wanted) {
    write_image(folder / "a.png", image, {.type = PixelType::Uint8, .color_tag = wanted});
    const std::string bytes = bytes_of(folder / "a.png");
    if (wanted == ColorTag::None) {
      for (const char* chunk : {"sRGB", "gAMA", "cHRM", "iCCP"}) {
        EXPECT_EQ(bytes.find(chunk), std::string::npos) << chunk;
      }
    }
    return inspect_image(folder / "a.png").color_space_tag;
  };
  EXPECT_EQ(tag(ColorTag::None), std::nullopt);
  EXPECT_EQ(tag(ColorTag::Srgb), "srgb_rec709_scene");
  EXPECT_EQ(tag(ColorTag::Linear), "lin_rec709_scene");
}

TEST_F(Png, ValuesDoNotDependOnTheColourTag) {
  const Layers image = pattern({16, 16}, {"R", "G", "B"});
  for (const ColorTag tag : {ColorTag::None, ColorTag::Srgb, ColorTag::Linear}) {
    write_image(folder / "a.png", image, {.type = PixelType::Uint8, .color_tag = tag});
    EXPECT_EQ(read_image(folder / "a.png").image.find("G")->at(7, 7), image.find("G")->at(7, 7));
  }
}

TEST_F(Png, RefusesAHeaderThatClaimsMoreThanTheFileCanHold) {
  CraftedPng image{.width = 16000, .height = 16000, .color_type = 2, .rows = {"x"}};
  const fs::path path = write_bytes("a.png", png(image));
  EXPECT_THAT(fault_text(Fault::Input, [&] { read_image(path); }),
              HasSubstr("truncated: the header claims 16000 x 16000 texels"));
}

TEST_F(Png, RefusesATruncatedFile) {
  write_image(folder / "a.png", pattern({64, 64}, {"R", "G", "B"}), {.type = PixelType::Uint16});
  const std::string bytes = bytes_of(folder / "a.png");
  for (const double share : {0.01, 0.3, 0.6, 0.9}) {
    const auto kept = static_cast<size_t>(share * static_cast<double>(bytes.size()));
    const fs::path path = write_bytes("cut.png", bytes.substr(0, kept));
    fault_text(Fault::Input, [&] { read_image(path); });
  }
}

}  // namespace
}  // namespace kiln

// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "crafted_files.h"
#include "image_folder.h"

namespace kiln {
namespace {

using namespace test;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

class Tiff : public ImageFolder {};

// How a 3 x 2 picture  a b c / d e f  is stored. EXIF 6: row 0 is the right edge, column 0 the top;
// EXIF 8: row 0 is the left edge, column 0 the bottom.
TEST_F(Tiff, IsTurnedUprightFromEveryOrientation) {
  const char* letters[] = {"abcdef", "cbafed", "fedcba", "defabc",
                           "adbecf", "cfbead", "fcebda", "daebfc"};
  for (uint32_t orientation = 1; orientation <= 8; ++orientation) {
    SCOPED_TRACE(orientation);
    const bool swapped = orientation >= 5;
    const fs::path path = write_bytes("a.tif", tiff({.width = swapped ? 2u : 3u,
                                                     .height = swapped ? 3u : 2u,
                                                     .orientation = orientation,
                                                     .pixels = letters[orientation - 1]}));
    const ImageFile file = read_image(path);
    ASSERT_EQ(file.image.size, (Size{3, 2}));
    EXPECT_EQ(inspect_image(path).size, (Size{3, 2}));
    std::string upright;
    for (int y = 0; y < 2; ++y) {
      for (const float v : file.image.layers[0].plane.texels_of_row(y)) {
        upright += static_cast<char>(v * 255.0f + 0.5f);
      }
    }
    EXPECT_EQ(upright, "abcdef");
    EXPECT_EQ(file.facts.notes.empty(), orientation == 1);
    EXPECT_EQ(file.facts.stored_as_shown, orientation == 1);
  }
}

TEST_F(Tiff, DividesColourByAlphaOnlyWhereTheFileSaysItWasMultiplied) {
  const std::string texel = "\x64\x32\x19\x80";
  const auto read = [&](int extra_sample) {
    return read_image(
        write_bytes("a.tif", tiff({.samples = 4, .extra_sample = extra_sample, .pixels = texel})));
  };
  const ImageFile straight = read(2);
  EXPECT_EQ(straight.image.find("R")->at(0, 0), 100.0f / 255);
  EXPECT_EQ(straight.image.find("A")->at(0, 0), 128.0f / 255);
  const ImageFile multiplied = read(1);
  EXPECT_NEAR(multiplied.image.find("R")->at(0, 0), 100.0f / 128, 1e-6);
  EXPECT_EQ(multiplied.image.find("A")->at(0, 0), 128.0f / 255);
  EXPECT_THAT(multiplied.facts.notes, Contains(HasSubstr("it was divided")));
}

TEST_F(Tiff, HoldsMoreThanFourChannels) {
  const Layers image = pattern({6, 5}, {"R", "G", "B", "A", "depth", "id"});
  write_image(folder / "a.tif", image, {.type = PixelType::Float});
  const ImageFile file = read_image(folder / "a.tif");
  ASSERT_EQ(file.image.layers.size(), 6u);
  for (size_t c = 0; c < 6; ++c) {
    EXPECT_EQ(file.image.layers[c].plane.at(5, 4), image.layers[c].plane.at(5, 4));
  }
}

TEST_F(Tiff, RefusesATruncatedFile) {
  write_image(folder / "a.tif", pattern({64, 64}, {"R", "G", "B"}), {.type = PixelType::Float});
  const std::string bytes = bytes_of(folder / "a.tif");
  for (const double share : {0.3, 0.6, 0.95}) {
    const auto kept = static_cast<size_t>(share * static_cast<double>(bytes.size()));
    const fs::path path = write_bytes("cut.tif", bytes.substr(0, kept));
    fault_text(Fault::Input, [&] { read_image(path); });
  }
}

class Jpeg : public ImageFolder {};

TEST_F(Jpeg, IsTurnedUprightByItsExifOrientation) {
  Layers image = make_layers({32, 16}, {"Y"});
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 32; ++x) image.layers[0].plane.at(x, y) = x < 16 ? 1.0f : 0.0f;
  }
  write_image(folder / "a.jpg", image, {.type = PixelType::Uint8});
  const fs::path path = write_bytes("b.jpg", with_exif_orientation(bytes_of(folder / "a.jpg"), 6));
  const ImageFile file = read_image(path);
  ASSERT_EQ(file.image.size, (Size{16, 32}));
  EXPECT_NEAR(file.image.layers[0].plane.at(8, 4), 1.0f, 0.02);
  EXPECT_NEAR(file.image.layers[0].plane.at(8, 28), 0.0f, 0.02);
  EXPECT_THAT(file.facts.notes, Contains(HasSubstr("orientation 6")));
}

TEST_F(Jpeg, StaysCloseOnASmoothImage) {
  Layers image = make_layers({64, 64}, {"R", "G", "B"});
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      image.layers[0].plane.at(x, y) = static_cast<float>(x) / 63;
      image.layers[1].plane.at(x, y) = static_cast<float>(y) / 63;
      image.layers[2].plane.at(x, y) = 0.5f;
    }
  }
  write_image(folder / "a.jpg", image, {.type = PixelType::Uint8});
  const ImageFile file = read_image(folder / "a.jpg");
  EXPECT_EQ(file.facts.color_space_tag, std::nullopt);
  for (size_t c = 0; c < 3; ++c) {
    for (int y = 0; y < 64; ++y) {
      for (int x = 0; x < 64; ++x) {
        ASSERT_NEAR(file.image.layers[c].plane.at(x, y), image.layers[c].plane.at(x, y), 0.03);
      }
    }
  }
}

TEST_F(Jpeg, RefusesEveryTruncation) {
  write_image(folder / "a.jpg", pattern({64, 64}, {"R", "G", "B"}), {.type = PixelType::Uint8});
  const std::string bytes = bytes_of(folder / "a.jpg");
  for (size_t kept = 3; kept < bytes.size(); kept += 97) {
    const fs::path path = write_bytes("cut.jpg", bytes.substr(0, kept));
    fault_text(Fault::Input, [&] { read_image(path); });
  }
}

TEST_F(Jpeg, AllowsBytesBehindTheImage) {
  write_image(folder / "a.jpg", pattern({16, 16}, {"R", "G", "B"}), {.type = PixelType::Uint8});
  const fs::path path = write_bytes("b.jpg", bytes_of(folder / "a.jpg") + "trailer");
  EXPECT_EQ(read_image(path).image.size, (Size{16, 16}));
}

class ByContents : public ImageFolder {};

TEST_F(ByContents, ReadsAFileUnderAnyName) {
  const Layers image = pattern({8, 8}, {"R", "G", "B"});
  for (const WritableFormat& format : writable_formats()) {
    if (format.name == "csv" || format.name == "h") continue;  // no images
    write_image(folder / named("a", format), image, {.type = format.types.front()});
    fs::rename(folder / named("a", format), folder / "a.picture");
    EXPECT_EQ(read_image(folder / "a.picture").facts.format, format.name);
  }
}

TEST_F(ByContents, ReadsAPortablePixmap) {
  const fs::path path = write_bytes("a.ppm", "P6\n2 1\n255\n\x10\x20\x30\x40\x50\x60");
  const ImageFile file = read_image(path);
  EXPECT_EQ(file.facts.format, "pnm");
  EXPECT_THAT(channel_names(file.image), ElementsAre("R", "G", "B"));
  EXPECT_EQ(file.image.find("R")->at(1, 0), 64.0f / 255);
}

}  // namespace
}  // namespace kiln

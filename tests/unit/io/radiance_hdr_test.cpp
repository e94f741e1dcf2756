// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <cmath>

#include "image_folder.h"

namespace kiln {
namespace {

using namespace test;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

const std::string opening = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n";

class RadianceHdr : public ImageFolder {
 protected:
  ImageFile read(const std::string& resolution, const std::string& pixels,
                 const std::string& lines = "") const {
    return read_image(write_bytes("a.hdr", opening + lines + "\n" + resolution + "\n" + pixels));
  }
};

// A pixel whose red is n / 2 (exponent 136 - 1).
std::string pixel(int n) { return std::string{static_cast<char>(n), 0, 0, '\x87'}; }

TEST_F(RadianceHdr, IsMantissaTimesAPowerOfTwo) {
  const ImageFile file = read("-Y 1 +X 3", std::string("\x80\x40\x20\x81", 4) + "\x01\x02\x03\x88" +
                                               std::string("\xff\xff\xff\x00", 4));
  EXPECT_THAT(file.image.find("R")->texels_of_row(0), ElementsAre(1.0f, 1.0f, 0.0f));
  EXPECT_THAT(file.image.find("G")->texels_of_row(0), ElementsAre(0.5f, 2.0f, 0.0f));
  EXPECT_THAT(file.image.find("B")->texels_of_row(0), ElementsAre(0.25f, 3.0f, 0.0f));
}

TEST_F(RadianceHdr, UnpacksRunsOfWholePixels) {
  const std::string repeat_4{1, 1, 1, 4};
  const ImageFile file =
      read("-Y 2 +X 6", pixel(10) + repeat_4 + pixel(20) + pixel(30) + std::string{1, 1, 1, 5});
  EXPECT_THAT(file.image.find("R")->texels_of_row(0), ElementsAre(5, 5, 5, 5, 5, 10));
  EXPECT_THAT(file.image.find("R")->texels_of_row(1), ElementsAre(15, 15, 15, 15, 15, 15));
}

TEST_F(RadianceHdr, WeighsRepeatsInARow256TimesMoreEach) {
  const ImageFile file =
      read("-Y 1 +X 600", pixel(10) + std::string{1, 1, 1, 87} + std::string{1, 1, 1, 2});
  EXPECT_EQ(file.image.find("R")->at(599, 0), 5);
}

TEST_F(RadianceHdr, UnpacksRunsOfComponents) {
  std::string line{2, 2, 0, 10};
  line += std::string{'\x8a', 4};                         // red: a run of ten
  line += std::string{10, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9};  // green: ten literals
  line += std::string{'\x85', 1, 5, 2, 2, 2, 2, 2};       // blue: both
  line += std::string{'\x8a', '\x88'};                    // exponent of 1
  const ImageFile file = read("-Y 1 +X 10", line);
  EXPECT_THAT(file.image.find("R")->texels_of_row(0), testing::Each(4.0f));
  EXPECT_THAT(file.image.find("G")->texels_of_row(0), ElementsAre(0, 1, 2, 3, 4, 5, 6, 7, 8, 9));
  EXPECT_THAT(file.image.find("B")->texels_of_row(0), ElementsAre(1, 1, 1, 1, 1, 2, 2, 2, 2, 2));
}

// A 3 x 2 picture  a b c / d e f, stored in each of the eight ways.
TEST_F(RadianceHdr, TurnsEveryOrientationUpright) {
  const std::pair<const char*, const char*> ways[] = {
      {"-Y 2 +X 3", "abcdef"}, {"-Y 2 -X 3", "cbafed"}, {"+Y 2 -X 3", "fedcba"},
      {"+Y 2 +X 3", "defabc"}, {"+X 3 -Y 2", "adbecf"}, {"-X 3 -Y 2", "cfbead"},
      {"-X 3 +Y 2", "fcebda"}, {"+X 3 +Y 2", "daebfc"}};
  for (const auto& [resolution, letters] : ways) {
    SCOPED_TRACE(resolution);
    std::string pixels;
    for (const char* letter = letters; *letter != 0; ++letter) pixels += pixel(2 * (*letter - 'a'));
    const ImageFile file = read(resolution, pixels);
    ASSERT_EQ(file.image.size, (Size{3, 2}));
    EXPECT_EQ(file.facts.size, (Size{3, 2}));
    EXPECT_THAT(file.image.find("R")->texels_of_row(0), ElementsAre(0, 1, 2));
    EXPECT_THAT(file.image.find("R")->texels_of_row(1), ElementsAre(3, 4, 5));
    EXPECT_EQ(file.facts.notes.empty(), std::string(resolution) == "-Y 2 +X 3");
  }
}

TEST_F(RadianceHdr, RefusesFewerScanLinesThanClaimed) {
  EXPECT_THAT(fault_text(Fault::Input, [&] { read("-Y 3 +X 2", pixel(1) + pixel(2)); }),
              HasSubstr("truncated: the header claims 3 scan lines of 2 texels"));
  EXPECT_THAT(
      fault_text(Fault::Input, [&] { read("-Y 2 +X 2", pixel(1) + pixel(2) + pixel(3) + "ab"); }),
      HasSubstr("truncated: the pixels end before the last scan line"));
}

TEST_F(RadianceHdr, RefusesEveryTruncationOfWhatItWrites) {
  write_image(folder / "whole.hdr", pattern({40, 12}, {"R", "G", "B"}), {.type = PixelType::Float});
  const std::string bytes = bytes_of(folder / "whole.hdr");
  for (size_t kept = 1; kept < bytes.size(); kept += 5) {
    const fs::path path = write_bytes("cut.hdr", bytes.substr(0, kept));
    fault_text(Fault::Input, [&] { read_image(path); });
  }
  EXPECT_EQ(read_image(folder / "whole.hdr").image.size, (Size{40, 12}));
}

TEST_F(RadianceHdr, RefusesRunsThatLeaveTheirScanLine) {
  EXPECT_THAT(fault_text(Fault::Input,
                         [&] {
                           read("-Y 1 +X 10", std::string{2, 2, 0, 10, '\x8b', 4} + pixel(1));
                         }),
              HasSubstr("a run leaves its scan line"));
  EXPECT_THAT(fault_text(Fault::Input,
                         [&] {
                           read("-Y 1 +X 4", pixel(1) + std::string{1, 1, 1, 9} + pixel(1));
                         }),
              HasSubstr("a run leaves its scan line"));
  EXPECT_THAT(fault_text(Fault::Input,
                         [&] {
                           read("-Y 1 +X 4", std::string{1, 1, 1, 2} + pixel(1));
                         }),
              HasSubstr("a run leaves its scan line"));
}

TEST_F(RadianceHdr, RefusesAResolutionItDoesNotUnderstand) {
  for (const char* line : {"", "-Y 512", "-Y 0 +X 5", "-Y 4 +Y 4", "4 4", "-Y 99999999999 +X 2"}) {
    EXPECT_THAT(fault_text(Fault::Input, [&] { read(line, pixel(1)); }),
                HasSubstr("resolution line"))
        << line;
  }
}

TEST_F(RadianceHdr, RefusesXyz) {
  const fs::path path =
      write_bytes("a.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\n" + pixel(1));
  EXPECT_THAT(fault_text(Fault::Input, [&] { read_image(path); }),
              HasSubstr("pixels are XYZE, expected RGBE"));
}

TEST_F(RadianceHdr, NotesAnExposure) {
  const ImageFile file = read("-Y 1 +X 1", pixel(2), "EXPOSURE=2.0\n");
  EXPECT_EQ(file.image.find("R")->at(0, 0), 1);
  EXPECT_THAT(file.facts.notes, Contains(HasSubstr("EXPOSURE=2.0")));
}

TEST_F(RadianceHdr, WritesEveryMantissaToTheNearest) {
  Layers image = make_layers({64, 3}, {"R", "G", "B"});
  for (int y = 0; y < 3; ++y) {
    for (int x = 0; x < 64; ++x) {
      const float scale = std::exp2(static_cast<float>(x) - 20);
      image.layers[0].plane.at(x, y) = scale * 1.37f;
      image.layers[1].plane.at(x, y) = scale * 0.61f;
      image.layers[2].plane.at(x, y) = scale * (y == 0 ? 1.9999f : 0.013f);
    }
  }
  const WriteFacts facts = write_image(folder / "a.hdr", image, {.type = PixelType::Float});
  EXPECT_EQ(facts.clamped, 0);
  const Layers read = read_image(folder / "a.hdr").image;
  for (int y = 0; y < 3; ++y) {
    for (int x = 0; x < 64; ++x) {
      const float largest =
          std::max({image.layers[0].plane.at(x, y), image.layers[1].plane.at(x, y),
                    image.layers[2].plane.at(x, y)});
      for (size_t c = 0; c < 3; ++c) {
        ASSERT_NEAR(read.layers[c].plane.at(x, y), image.layers[c].plane.at(x, y), largest / 256);
      }
    }
  }
}

TEST_F(RadianceHdr, ComesBackBitForBitOnceStored) {
  write_image(folder / "a.hdr", pattern({50, 50}, {"R", "G", "B"}), {.type = PixelType::Float});
  write_image(folder / "b.hdr", read_image(folder / "a.hdr").image, {.type = PixelType::Float});
  EXPECT_EQ(bytes_of(folder / "a.hdr"), bytes_of(folder / "b.hdr"));
}

TEST_F(RadianceHdr, ClampsWhatRgbeCannotHold) {
  Layers image = make_layers({6, 1}, {"R", "G", "B"});
  const float values[] = {-1.0f, NAN, INFINITY, 3e38f, 1e-45f, 0.0f};
  for (Layer& layer : image.layers) {
    for (int x = 0; x < 6; ++x) layer.plane.at(x, 0) = values[x];
  }
  const WriteFacts facts = write_image(folder / "a.hdr", image, {.type = PixelType::Float});
  EXPECT_EQ(facts.clamped, 6);
  EXPECT_EQ(facts.not_a_number, 3);
  const float largest = 255 * 0x1p119f;
  EXPECT_THAT(read_image(folder / "a.hdr").image.find("G")->texels_of_row(0),
              ElementsAre(0, 0, largest, largest, 0, 0));
}

TEST_F(RadianceHdr, WritesNarrowPicturesFlat) {
  for (const int width : {1, 3, 7, 8, 9}) {
    const Layers image = pattern({width, 5}, {"R", "G", "B"});
    write_image(folder / "a.hdr", image, {.type = PixelType::Float});
    const Layers read = read_image(folder / "a.hdr").image;
    EXPECT_NEAR(read.find("B")->at(width - 1, 4), image.find("B")->at(width - 1, 4), 1.0 / 256);
  }
}

}  // namespace
}  // namespace kiln

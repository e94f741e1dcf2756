// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <array>
#include <bit>
#include <cmath>

#include "crafted_files.h"
#include "image_folder.h"
#include "kiln/io/number_arrays.h"
#include "kiln/io/texture_file.h"

namespace kiln {
namespace {

using namespace test;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr uint32_t half_one = 0x3c00, half_quarter = 0x3400;

std::string float_bytes(float value) { return little_endian(std::bit_cast<uint32_t>(value), 4); }

std::string words(std::initializer_list<uint32_t> numbers) {
  std::string bytes;
  for (const uint32_t number : numbers) bytes += little_endian(number, 4);
  return bytes;
}

struct CraftedDds {
  uint32_t width = 2;
  uint32_t height = 1;
  uint32_t mips = 1;
  uint32_t flags = 4;
  uint32_t four_cc = 0;
  uint32_t bits = 0;
  std::array<uint32_t, 4> masks{};
  uint32_t caps2 = 0;
  std::string behind = {};  ///< header of DirectX 10 and texels
};

std::string dds(const CraftedDds& file) {
  return "DDS " + words({124, 0x1007, file.height, file.width, 0, 0, file.mips}) +
         std::string(44, '\0') +
         words({32, file.flags, file.four_cc, file.bits, file.masks[0], file.masks[1],
                file.masks[2], file.masks[3], 0x1000, file.caps2, 0, 0, 0}) +
         file.behind;
}

constexpr uint32_t dx10 = 0x30315844;

std::string dx10_header(uint32_t format, uint32_t flags = 0, uint32_t images = 1) {
  return words({format, 3, flags, images, 0});
}

class Textures : public ImageFolder {
 protected:
  // The texels of the first row, channel by channel.
  std::vector<float> row(const std::string& bytes, const std::vector<std::string>& names) const {
    const ImageFile file = read_image(write_bytes("texture", bytes));
    EXPECT_EQ(channel_names(file.image), names);
    std::vector<float> values;
    for (const Layer& layer : file.image.layers) {
      for (const float value : layer.plane.texels_of_row(0)) values.push_back(value);
    }
    return values;
  }
};

TEST_F(Textures, LegacyDdsOfFloatsAreNumbersWhereLettersWouldBe) {
  const std::string one = little_endian(half_one, 2), quarter = little_endian(half_quarter, 2);
  EXPECT_THAT(row(dds({.four_cc = 111, .behind = one + quarter}), {"Y"}), ElementsAre(1, 0.25f));
  EXPECT_THAT(row(dds({.four_cc = 112, .behind = one + quarter + quarter + one}), {"R", "G"}),
              ElementsAre(1, 0.25f, 0.25f, 1));
  EXPECT_THAT(row(dds({.width = 1, .four_cc = 113, .behind = one + quarter + one + one}),
                  {"R", "G", "B", "A"}),
              ElementsAre(1, 0.25f, 1, 1));
  EXPECT_THAT(row(dds({.four_cc = 114, .behind = float_bytes(0.1f) + float_bytes(-2)}), {"Y"}),
              ElementsAre(0.1f, -2));
  EXPECT_THAT(
      row(dds({.width = 1, .four_cc = 115, .behind = float_bytes(3) + float_bytes(5)}), {"R", "G"}),
      ElementsAre(3, 5));
  EXPECT_THAT(
      row(dds({.width = 1,
               .four_cc = 116,
               .behind = float_bytes(1) + float_bytes(2) + float_bytes(3) + float_bytes(4)}),
          {"R", "G", "B", "A"}),
      ElementsAre(1, 2, 3, 4));
}

TEST_F(Textures, LegacyDdsOfMasksAreReadInEveryOrder) {
  const auto rgb = [&](uint32_t bits, std::array<uint32_t, 4> masks, const std::string& texel) {
    const uint32_t flags = masks[3] != 0 ? 0x41 : 0x40;
    return dds({.width = 1, .flags = flags, .bits = bits, .masks = masks, .behind = texel});
  };
  const std::vector<std::string> color{"R", "G", "B"}, with_alpha{"R", "G", "B", "A"};
  EXPECT_THAT(row(rgb(24, {0xff0000, 0xff00, 0xff, 0}, std::string("\xff\x33\0", 3)), color),
              ElementsAre(0, 0.2f, 1));
  EXPECT_THAT(row(rgb(32, {0xff0000, 0xff00, 0xff, 0xff000000}, std::string("\xff\x33\0\x66", 4)),
                  with_alpha),
              ElementsAre(0, 0.2f, 1, 0.4f));
  EXPECT_THAT(row(rgb(32, {0xff, 0xff00, 0xff0000, 0xff000000}, std::string("\xff\x33\0\x66", 4)),
                  with_alpha),
              ElementsAre(1, 0.2f, 0, 0.4f));
  EXPECT_THAT(row(rgb(32, {0xff0000, 0xff00, 0xff, 0}, std::string("\xff\x33\0\x66", 4)), color),
              ElementsAre(0, 0.2f, 1));
  EXPECT_THAT(
      row(rgb(32, {0xffff, 0xffff0000, 0, 0}, std::string("\xff\xff\x33\x33", 4)), {"R", "G"}),
      ElementsAre(1, 0.2f));
  EXPECT_THAT(row(rgb(32, {0x3ff, 0xffc00, 0x3ff00000, 0xc0000000},
                      little_endian(1023u | 341u << 10 | 2u << 30, 4)),
                  with_alpha),
              ElementsAre(1, 341.0f / 1023, 0, 2.0f / 3));
  const auto luminance = [&](uint32_t bits, uint32_t mask, const std::string& texel) {
    return dds({.width = 1, .flags = 0x20000, .bits = bits, .masks = {mask}, .behind = texel});
  };
  EXPECT_THAT(row(luminance(8, 0xff, "\x33"), {"Y"}), ElementsAre(0.2f));
  EXPECT_THAT(row(luminance(16, 0xffff, "\x33\x33"), {"Y"}), ElementsAre(0.2f));
}

TEST_F(Textures, DdsOfDirectX10HoldsPackedFloats) {
  const auto packed = [](uint32_t format, uint32_t texel) {
    return dds(
        {.width = 1, .four_cc = dx10, .behind = dx10_header(format) + little_endian(texel, 4)});
  };
  // 1, 0.5 and 4: exponents 15, 14 and 17 over no mantissa.
  EXPECT_THAT(row(packed(26, 15u << 6 | (14u << 6) << 11 | (17u << 5) << 22), {"R", "G", "B"}),
              ElementsAre(1, 0.5f, 4));
  // Mantissas 256, 128, 511 with the exponent 16: times 2^(16 - 24).
  EXPECT_THAT(row(packed(67, 256u | 128u << 9 | 511u << 18 | 16u << 27), {"R", "G", "B"}),
              ElementsAre(1, 0.5f, 511.0f / 256));
  EXPECT_THAT(row(packed(87, 0x660033ff), {"R", "G", "B", "A"}), ElementsAre(0, 0.2f, 1, 0.4f));
}

TEST_F(Textures, TheFirstFaceAndLevelIsTheImageAndANoteSaysSo) {
  const std::string texels(64, '\x33');
  const fs::path mips = write_bytes(
      "mips.dds", dds({.mips = 2, .flags = 0x20000, .bits = 8, .masks = {0xff}, .behind = texels}));
  EXPECT_THAT(read_image(mips).facts.notes, ElementsAre("2 mip levels; the largest is read"));
  const fs::path cube =
      write_bytes("cube.dds", dds({.four_cc = dx10, .behind = dx10_header(61, 4, 2) + texels}));
  EXPECT_THAT(read_image(cube).facts.notes,
              ElementsAre("a cube; its first face is read", "an array of 2; the first is read"));
  EXPECT_EQ(read_image(cube).image.size, (Size{2, 1}));
}

TEST_F(Textures, LegacyDdsCubesHaveAllTheirFacesAndLevelsAsTextures) {
  std::string texels;
  for (uint32_t face = 0; face < 6; ++face) {
    for (uint32_t n = 0; n < 5; ++n) texels += float_bytes(static_cast<float>(10 * face + n));
  }
  CraftedDds file{.width = 2, .height = 2, .mips = 2, .four_cc = 114, .behind = texels};
  file.caps2 = 0xfe00;
  const TextureFile cube = read_texture(write_bytes("cube.dds", dds(file)));
  ASSERT_EQ(cube.texture.levels.size(), 2u);
  ASSERT_EQ(cube.texture.levels[1].size(), 6u);
  for (size_t f = 0; f < 6; ++f) {
    EXPECT_EQ(cube.texture.levels[0][f].layers[0].plane.at(1, 1), 10.0f * float(f) + 3);
    EXPECT_EQ(cube.texture.levels[1][f].layers[0].plane.at(0, 0), 10.0f * float(f) + 4);
  }
  EXPECT_TRUE(cube.facts.notes.empty());
  file.caps2 = 0x0e00;
  EXPECT_THAT(fault_text(Fault::Input, [&] { read_texture(write_bytes("part.dds", dds(file))); }),
              HasSubstr("a cube of 2 faces, expected all six"));
}

TEST_F(Textures, SaysWhichFormatOfDdsIsTruncated) {
  const fs::path path = write_bytes("a.dds", dds({.width = 4, .four_cc = 116, .behind = "abc"}));
  EXPECT_THAT(fault_text(Fault::Input, [&] { read_image(path); }),
              HasSubstr("a.dds: truncated: the header claims 4 x 1 x 1 texels of 16 bytes, 3 bytes "
                        "follow"));
  const fs::path large = write_bytes(
      "b.dds", dds({.width = 1 << 30, .height = 1 << 30, .four_cc = 116, .behind = "abc"}));
  EXPECT_THAT(fault_text(Fault::Input, [&] { read_image(large); }), HasSubstr("are not read"));
}

struct CraftedKtx {
  uint32_t type = 0x1406;
  uint32_t format = 0x1903;
  uint32_t width = 2;
  uint32_t height = 1;
  uint32_t depth = 0;
  std::string keys = {};
  std::string texels = {};
};

std::string ktx1(const CraftedKtx& file, bool big = false) {
  const auto number = [&](uint32_t value) {
    return big ? big_endian(value, 4) : little_endian(value, 4);
  };
  std::string bytes = "\xabKTX 11\xbb\r\n\x1a\n";
  for (const uint32_t value :
       {0x04030201u, file.type, 4u, file.format, 0u, file.format, file.width, file.height,
        file.depth, 0u, 1u, 1u, static_cast<uint32_t>(file.keys.size())}) {
    bytes += number(value);
  }
  return bytes + file.keys + number(static_cast<uint32_t>(file.texels.size())) + file.texels;
}

std::string key(const std::string& text) {
  std::string bytes = little_endian(static_cast<uint32_t>(text.size()), 4) + text;
  bytes.resize((bytes.size() + 3) / 4 * 4, '\0');
  return bytes;
}

TEST_F(Textures, KtxOfVersionOnePadsItsRowsAndHasAnyByteOrder) {
  const std::string texels("\x33\xff\0\0\0\x66\0\0", 8);
  const CraftedKtx bytes{.type = 0x1401, .height = 2, .texels = texels};
  EXPECT_THAT(row(ktx1(bytes), {"Y"}), ElementsAre(0.2f, 1));
  EXPECT_EQ(read_image(folder / "texture").image.find("Y")->at(1, 1), 0.4f);
  const std::string number = big_endian(std::bit_cast<uint32_t>(0.1f), 4);
  EXPECT_THAT(row(ktx1({.width = 1, .texels = number}, true), {"Y"}), ElementsAre(0.1f));
  EXPECT_THAT(row(ktx1({.type = 0x140b,
                        .format = 0x1907,
                        .width = 1,
                        .texels = std::string("\0\x3c\0\x34\0\x40\0\0", 8)}),
                  {"R", "G", "B"}),
              ElementsAre(1, 0.25f, 2));
}

TEST_F(Textures, KtxKeysAreAttributesAndTurnTheRows) {
  const std::string keys =
      key(std::string("KTXorientation\0S=r,T=u\0", 23)) + key(std::string("axes\0mu\0", 8));
  const fs::path path = write_bytes(
      "a.ktx",
      ktx1({.width = 1, .height = 2, .keys = keys, .texels = float_bytes(1) + float_bytes(2)}));
  const ImageFile file = read_image(path);
  EXPECT_EQ(file.image.find("Y")->at(0, 0), 2);
  EXPECT_THAT(file.facts.notes, ElementsAre(HasSubstr("rows were stored from the bottom")));
  EXPECT_THAT(file.facts.attributes,
              ElementsAre(std::pair<std::string, std::string>{"axes", "mu"}));
}

TEST_F(Textures, KtxVolumesAreArraysOfFourAxes) {
  std::string texels;
  for (int i = 0; i < 12; ++i) texels += float_bytes(static_cast<float>(i));
  const fs::path path =
      write_bytes("a.ktx", ktx1({.width = 2, .height = 3, .depth = 2, .texels = texels}));
  const NumberArray array = read_arrays(path).front();
  EXPECT_THAT(array.shape, ElementsAre(2, 3, 2, 1));
  EXPECT_EQ(array.values[11], 11);
  EXPECT_EQ(read_image(path).image.size, (Size{2, 6}));
}

TEST_F(Textures, NamesWhatOfKtxIsNotRead) {
  const fs::path block = write_bytes("a.ktx", ktx1({.type = 0, .format = 0}));
  EXPECT_THAT(fault_text(Fault::Input, [&] { read_image(block); }), HasSubstr("block-compressed"));
  write_image(folder / "b.ktx2", pattern({4, 4}, {"E"}), {});
  std::string bytes = bytes_of(folder / "b.ktx2");
  bytes[44] = 3;
  EXPECT_THAT(fault_text(Fault::Input, [&] { read_image(write_bytes("c.ktx2", bytes)); }),
              HasSubstr("c.ktx2: supercompressed with ZLIB, which is not read"));
  bytes[44] = 2;
  EXPECT_THAT(fault_text(Fault::Input, [&] { read_image(write_bytes("c.ktx2", bytes)); }),
              HasSubstr("c.ktx2: damaged Zstandard frame"));
  bytes[44] = 0;
  bytes[12] = static_cast<char>(145);
  EXPECT_THAT(fault_text(Fault::Input, [&] { read_image(write_bytes("d.ktx2", bytes)); }),
              HasSubstr("VkFormat 145"));
}

}  // namespace
}  // namespace kiln

// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <cstring>
#include <nlohmann/json.hpp>

#include "crafted_files.h"
#include "support/outside_command.h"
#include "texture_pattern.h"

// What the specifications demand, byte by byte.
namespace kiln {
namespace {

using namespace test;
using testing::Contains;
using testing::ElementsAre;
using testing::ElementsAreArray;
using testing::HasSubstr;
using testing::Pair;

using Words = std::vector<uint32_t>;

class Containers : public ImageFolder {
 protected:
  std::string written(const std::string& name, const Texture& texture,
                      const TextureWriteOptions& options) const {
    write_texture(folder / name, texture, options);
    return bytes_of(folder / name);
  }

  static Words words(const std::string& bytes, size_t at, size_t count) {
    Words numbers(count);
    std::memcpy(numbers.data(), bytes.data() + at, 4 * count);
    return numbers;
  }
};

struct Level {
  uint64_t place, stored, texels;
};

std::vector<Level> level_index(const std::string& ktx2) {
  std::vector<Level> levels(static_cast<uint8_t>(ktx2[40]));
  std::memcpy(levels.data(), ktx2.data() + 80, 24 * levels.size());
  return levels;
}

TEST_F(Containers, Ktx2SaysWhatItHolds) {
  const std::string bytes = written("a.ktx2", cube(4, 3), {.attributes = {{"b", "x"}, {"A", "y"}}});
  constexpr uint32_t rgba16f = 97;
  EXPECT_THAT(words(bytes, 12, 9), ElementsAre(rgba16f, 2, 4, 4, 0, 0, 6, 3, 0));
  const Words places = words(bytes, 48, 8);
  EXPECT_THAT(places, ElementsAre(80 + 3 * 24, 4 + 24 + 4 * 16, places[0] + places[1], places[3], 0,
                                  0, 0, 0));
  const std::string keys = bytes.substr(places[2], places[3]);
  const size_t first = keys.find("A"), orientation = keys.find("KTXorientation"),
               writer = keys.find("KTXwriter"), last = keys.find("b");
  EXPECT_TRUE(first < orientation && orientation < writer && writer < last) << "sorted";
  EXPECT_EQ(keys.substr(orientation + 15, 3), std::string("rd\0", 3));
}

TEST_F(Containers, Ktx2PutsTheSmallestLevelFirstAndAlignsEach) {
  struct Case {
    PixelType type;
    std::vector<std::string> names;
    size_t texel, step;
  };
  for (const Case& one :
       {Case{PixelType::Half, {"R", "G", "B"}, 8, 8},
        Case{PixelType::Float, {"R", "G", "B", "A"}, 16, 16}, Case{PixelType::Half, {"Y"}, 2, 4},
        Case{PixelType::B10g11r11, {"R", "G", "B"}, 4, 4},
        Case{PixelType::E5b9g9r9, {"R", "G", "B"}, 4, 4}}) {
    for (const size_t faces : {1, 6}) {
      const std::string bytes =
          written("a.ktx2", textured({5, 5}, 3, faces, one.names), {.type = one.type});
      const std::vector<Level> levels = level_index(bytes);
      ASSERT_EQ(levels.size(), 3u);
      size_t end = words(bytes, 56, 1)[0] + words(bytes, 60, 1)[0];
      for (size_t p = 3; p-- > 0;) {
        const size_t edge = 5 >> p;
        EXPECT_EQ(levels[p].place, (end + one.step - 1) / one.step * one.step);
        EXPECT_EQ(levels[p].stored, edge * edge * faces * one.texel);
        EXPECT_EQ(levels[p].texels, levels[p].stored);
        end = levels[p].place + levels[p].stored;
      }
      EXPECT_EQ(bytes.size(), end);
    }
  }
}

TEST_F(Containers, Ktx2PacksEachLevelWithZstandard) {
  const Texture texture = cube(8, 4);
  const std::vector<Level> plain = level_index(written("a.ktx2", texture, {}));
  const std::string bytes =
      written("b.ktx2", texture, {.supercompression = Supercompression::Zstd});
  EXPECT_EQ(words(bytes, 44, 1)[0], 2u);
  const std::vector<Level> packed = level_index(bytes);
  size_t end = words(bytes, 56, 1)[0] + words(bytes, 60, 1)[0];
  for (size_t p = 4; p-- > 0;) {
    EXPECT_EQ(packed[p].texels, plain[p].texels);
    EXPECT_EQ(packed[p].place, end) << "no padding between packed levels";
    EXPECT_EQ(bytes.substr(end, 4), "\x28\xb5\x2f\xfd");
    end += packed[p].stored;
  }
  EXPECT_EQ(bytes.size(), end);
  EXPECT_EQ(read_texture(folder / "b.ktx2").supercompression, Supercompression::Zstd);
  EXPECT_LT(packed[0].stored, plain[0].stored);
}

// Of each sample: bits at, bits less one with channel and qualifiers above, lower, upper.
TEST_F(Containers, Ktx2DescribesEachTypeAsKhronosDoes) {
  const auto sample = [](uint32_t at, uint32_t bits, uint32_t kind, uint32_t lower,
                         uint32_t upper) {
    return Words{at | (bits - 1) << 16 | kind << 24, 0, lower, upper};
  };
  const auto expect = [&](PixelType type, uint32_t format, uint32_t texel,
                          const std::vector<Words>& samples) {
    const std::string bytes =
        written("a.ktx2", cube(1, 1), {.type = type, .color_tag = ColorTag::Linear});
    EXPECT_EQ(words(bytes, 12, 1)[0], format);
    const Words place = words(bytes, 48, 2);
    Words wanted{28 + 16 * static_cast<uint32_t>(samples.size()),
                 0,
                 2 | (24 + 16 * static_cast<uint32_t>(samples.size())) << 16,
                 0x00010101,
                 0,
                 texel,
                 0};
    for (const Words& one : samples) wanted.insert(wanted.end(), one.begin(), one.end());
    EXPECT_THAT(words(bytes, place[0], place[1] / 4), ElementsAreArray(wanted))
        << pixel_type_name(type);
  };
  constexpr uint32_t minus_one = 0xbf800000, one = 0x3f800000;
  expect(PixelType::Half, 97, 8,
         {sample(0, 16, 0xc0, minus_one, one), sample(16, 16, 0xc1, minus_one, one),
          sample(32, 16, 0xc2, minus_one, one), sample(48, 16, 0xcf, minus_one, one)});
  expect(PixelType::Float, 109, 16,
         {sample(0, 32, 0xc0, minus_one, one), sample(32, 32, 0xc1, minus_one, one),
          sample(64, 32, 0xc2, minus_one, one), sample(96, 32, 0xcf, minus_one, one)});
  expect(PixelType::B10g11r11, 122, 4,
         {sample(0, 11, 0x80, 0, one), sample(11, 11, 0x81, 0, one), sample(22, 10, 0x82, 0, one)});
  expect(PixelType::E5b9g9r9, 123, 4,
         {sample(0, 9, 0x00, 0, 8448), sample(27, 5, 0x20, 15, 31), sample(9, 9, 0x01, 0, 8448),
          sample(27, 5, 0x21, 15, 31), sample(18, 9, 0x02, 0, 8448), sample(27, 5, 0x22, 15, 31)});
}

TEST_F(Containers, DdsHasEachFaceWithItsLevels) {
  const Texture texture = cube(4, 3);
  const std::string bytes = written("a.dds", texture, {.type = PixelType::Float});
  EXPECT_EQ(bytes.substr(84, 4), "DX10");
  const Words header = words(bytes, 4, 7);
  EXPECT_THAT(header, ElementsAre(124, 0x2100f, 4, 4, 4 * 16, 0, 3));
  EXPECT_THAT(words(bytes, 108, 2), ElementsAre(0x401008, 0xfe00));
  EXPECT_THAT(words(bytes, 128, 5), ElementsAre(2, 3, 4, 1, 0));
  constexpr size_t chain = (16 + 4 + 1) * 16;
  EXPECT_EQ(bytes.size(), 148 + 6 * chain);
  float value = 0;
  std::memcpy(&value, bytes.data() + 148 + 4 * chain + (16 + 3) * 16 + 4, 4);
  EXPECT_EQ(value, texture.levels[1][4].find("G")->at(1, 1));
  EXPECT_EQ(words(written("b.dds", cube(1, 1), {.type = PixelType::B10g11r11}), 128, 1)[0], 26u);
  EXPECT_EQ(words(written("b.dds", cube(1, 1), {.type = PixelType::E5b9g9r9}), 128, 1)[0], 67u);
  const std::string image = written("c.dds", textured({4, 2}, 2, 1, {"R"}), {});
  EXPECT_THAT(words(image, 108, 2), ElementsAre(0x401008, 0));
  EXPECT_THAT(words(image, 128, 5), ElementsAre(54, 3, 0, 1, 0));
}

TEST_F(Containers, Ktx1HasTheNumbersOfOpenGl) {
  const auto numbers = [&](PixelType type, const std::vector<std::string>& names) {
    return words(written("a.ktx", cube(4, 3, names), {.type = type}), 12, 6);
  };
  const std::vector<std::string> rgb{"R", "G", "B"};
  EXPECT_THAT(numbers(PixelType::Half, rgb),
              ElementsAre(0x04030201, 0x140b, 2, 0x1908, 0x881a, 0x1908));
  EXPECT_THAT(numbers(PixelType::Float, rgb),
              ElementsAre(0x04030201, 0x1406, 4, 0x1908, 0x8814, 0x1908));
  EXPECT_THAT(numbers(PixelType::Half, {"R", "G"}),
              ElementsAre(0x04030201, 0x140b, 2, 0x8227, 0x822f, 0x8227));
  EXPECT_THAT(numbers(PixelType::Float, {"Y"}),
              ElementsAre(0x04030201, 0x1406, 4, 0x1903, 0x822e, 0x1903));
  EXPECT_THAT(numbers(PixelType::B10g11r11, rgb),
              ElementsAre(0x04030201, 0x8c3a, 4, 0x1907, 0x8c3a, 0x1907));
  EXPECT_THAT(numbers(PixelType::E5b9g9r9, rgb),
              ElementsAre(0x04030201, 0x8c3e, 4, 0x1907, 0x8c3d, 0x1907));
  const std::string bytes = bytes_of(folder / "a.ktx");
  EXPECT_THAT(words(bytes, 36, 6), ElementsAre(4, 4, 0, 0, 6, 3));
}

TEST_F(Containers, Ktx1StatesTheBytesOfAFaceOfACubeAndPadsRows) {
  // Three halves in a row are 6 bytes, padded to 8; then one, padded from 2 to 4.
  for (const size_t faces : {1, 6}) {
    const std::string bytes = written("a.ktx", textured({3, 3}, 2, faces, {"Y"}), {});
    const size_t first = 64 + words(bytes, 60, 1)[0];
    EXPECT_EQ(words(bytes, first, 1)[0], 3 * 8u);
    const size_t second = first + 4 + faces * 24;
    EXPECT_EQ(words(bytes, second, 1)[0], 4u);
    EXPECT_EQ(bytes.size(), second + 4 + faces * 4);
  }
}

// What Filament's own tool wrote, read and written again, is the same but for the numbers that it
// gets wrong (bytes of a type, format, base format) and our keys.
TEST_F(Containers, Ktx1IsWhatFilamentsToolWrites) {
  const std::string tool = program("cmgen");
  if (tool.empty()) GTEST_SKIP() << "no cmgen: Debian's libfilament-tools is not installed";
  Layers sky = latlong_at_nodes(64, 1, smooth_light).levels[0][0];
  write_image(folder / "sky.hdr", sky, {.type = PixelType::Float});
  ASSERT_EQ(run({tool, "-q", "-x", (folder / "out").string(), "--format=ktx", "--size=32",
                 (folder / "sky.hdr").string()})
                .code,
            0);
  const fs::path theirs = folder / "out" / "out_ibl.ktx";
  const TextureFile file = read_texture(theirs);
  EXPECT_TRUE(file.texture.is_cube());
  EXPECT_EQ(file.stored, PixelType::B10g11r11);
  EXPECT_EQ(file.facts.size, (Size{32, 32}));
  EXPECT_THAT(file.facts.attributes, Contains(Pair("sh", HasSubstr("\n"))));
  const WriteFacts facts =
      write_texture(folder / "ours.ktx", file.texture,
                    {.type = PixelType::B10g11r11, .attributes = file.facts.attributes});
  EXPECT_EQ(facts.clamped, 0);
  const std::string a = bytes_of(theirs), b = bytes_of(folder / "ours.ktx");
  EXPECT_EQ(words(a, 12, 2), words(b, 12, 2));
  EXPECT_EQ(words(a, 28, 1), words(b, 28, 1)) << "internal format";
  EXPECT_EQ(words(a, 36, 6), words(b, 36, 6));
  EXPECT_EQ(a.substr(64 + words(a, 60, 1)[0]), b.substr(64 + words(b, 60, 1)[0]));
}

TEST_F(Containers, FilamentsCubeHasNoSeamsAsItIsRead) {
  const std::string tool = program("cmgen");
  if (tool.empty()) GTEST_SKIP() << "no cmgen: Debian's libfilament-tools is not installed";
  write_image(folder / "sky.hdr", latlong_at_nodes(64, 1, smooth_light).levels[0][0],
              {.type = PixelType::Float});
  run({tool, "-q", "-x", (folder / "out").string(), "--format=ktx", "--size=32",
       (folder / "sky.hdr").string()});
  const TextureFile file = read_texture(folder / "out" / "out_skybox.ktx");
  EXPECT_LT(greatest_seam(file.texture.levels[0]), 1.5 * greatest_step(file.texture.levels[0]));
}

class BabylonEnv : public Containers {
 protected:
  static nlohmann::json manifest(const std::string& bytes) {
    return nlohmann::json::parse(bytes.substr(8, bytes.find('\0', 8) - 8));
  }
  static std::string image(const std::string& bytes, size_t n) {
    const nlohmann::json place = manifest(bytes)["specular"]["mipmaps"][n];
    return bytes.substr(bytes.find('\0', 8) + 1 + place["position"].get<size_t>(),
                        place["length"].get<size_t>());
  }
};

TEST_F(BabylonEnv, HasTheManifestThatItsLoaderReads) {
  IrradiancePolynomial polynomial;
  polynomial.x = {1, 2, 3};
  polynomial.zx = {-0.5, 0.1, 1e-9};
  const std::string bytes =
      written("a.env", cube(4, 3),
              {.type = PixelType::Rgbd8, .irradiance = polynomial, .lod_generation_scale = 0.75});
  EXPECT_EQ(bytes.substr(0, 8), "\x86\x16\x87\x96\xf6\xd6\x96\x36");
  const nlohmann::json found = manifest(bytes);
  EXPECT_EQ(found["version"], 1);
  EXPECT_EQ(found["width"], 4);
  EXPECT_EQ(found["imageType"], "image/png");
  EXPECT_EQ(found["irradiance"].size(), 9u);
  EXPECT_EQ(found["irradiance"]["zx"], (std::vector<double>{-0.5, 0.1, 1e-9}));
  EXPECT_EQ(found["specular"]["lodGenerationScale"], 0.75);
  const nlohmann::json places = found["specular"]["mipmaps"];
  ASSERT_EQ(places.size(), 18u);
  size_t end = 0;
  for (const nlohmann::json& place : places) {
    EXPECT_EQ(place["position"], end);
    end += place["length"].get<size_t>();
  }
  EXPECT_EQ(bytes.find('\0', 8) + 1 + end, bytes.size());
  const TextureFile file = read_texture(folder / "a.env");
  EXPECT_EQ(file.irradiance->zx, polynomial.zx);
  EXPECT_EQ(file.lod_generation_scale, 0.75);
  EXPECT_EQ(manifest(written("b.env", cube(1, 1), {.type = PixelType::Rgbd8}))["irradiance"],
            nullptr);
}

TEST_F(BabylonEnv, HoldsTheRowsOfEachFaceFromTheBottom) {
  const Texture texture = cube(4, 3);
  const std::string bytes = written("a.env", texture, {.type = PixelType::Rgbd8});
  for (size_t n = 0; n < 18; ++n) {
    const Layers png = read_image(write_bytes("face.png", image(bytes, n))).image;
    const Layers& face = texture.levels[n / 6][n % 6];
    ASSERT_EQ(png.size, face.size);
    EXPECT_THAT(channel_names(png), ElementsAre("R", "G", "B", "A"));
    for (int y = 0; y < png.size.height; ++y) {
      const float decoded = std::pow(png.find("G")->at(0, png.size.height - 1 - y), 2.2f) /
                            png.find("A")->at(0, png.size.height - 1 - y);
      EXPECT_NEAR(decoded, face.find("G")->at(0, y), 0.01 * face.find("G")->at(0, y) + 0.01);
    }
  }
}

TEST_F(BabylonEnv, IsRefusedWithItsReasonWhenDamaged) {
  const std::string bytes = written("a.env", cube(2, 2), {.type = PixelType::Rgbd8});
  const auto fault = [&](const std::string& what, const std::string& instead) {
    std::string changed = bytes;
    changed.replace(changed.find(what), what.size(), instead);
    return fault_text(Fault::Input, [&] { read_texture(write_bytes("b.env", changed)); });
  };
  EXPECT_THAT(fault("\"width\"", "\"depth\""), HasSubstr("no whole 'width'"));
  EXPECT_THAT(fault("\"width\":2", "\"width\":4"), HasSubstr("expected 4 x 4 and RGBD"));
  EXPECT_THAT(fault("\"width\":2", "\"width\":1"), HasSubstr("2 mip levels of 1 x 1"));
  EXPECT_THAT(fault("{\"version\"", "[\"version\""), HasSubstr("no JSON"));
  EXPECT_THAT(fault("\"mipmaps\"", "\"nipnaps\""), HasSubstr("places 0 images"));
  EXPECT_THAT(fault("\"position\":0", "\"position\":-1"), HasSubstr("no whole 'position'"));
  EXPECT_THAT(fault("\x89PNG", "\x89png"), HasSubstr("neither PNG nor WebP"));
  EXPECT_THAT(
      fault_text(Fault::Input, [&] { read_texture(write_bytes("c.env", bytes.substr(0, 600))); }),
      HasSubstr("c.env: truncated"));
}

}  // namespace
}  // namespace kiln

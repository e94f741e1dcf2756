// SPDX-License-Identifier: Apache-2.0
#include <OpenImageIO/imageio.h>
#include <OpenImageIO/texture.h>
#include <gmock/gmock.h>

#include <bit>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "kiln/io/texture_writer.h"
#include "support/outside_command.h"
#include "support/places.h"
#include "texture_pattern.h"

// Every container with a reader outside the project, read back by it. What is not installed skips.
namespace kiln {
namespace {

using namespace test;
using testing::ElementsAre;
using testing::HasSubstr;

class Readers : public ImageFolder {};

// One level as OpenImageIO reads it: all channels, one texel behind the other.
struct Read {
  OIIO::ImageSpec spec;
  std::vector<float> texels;

  float at(int x, int y, int channel) const {
    return texels[static_cast<size_t>((y * spec.width + x) * spec.nchannels + channel)];
  }
};

std::vector<Read> levels_of(const fs::path& path) {
  std::vector<Read> levels;
  const auto input = OIIO::ImageInput::open(path.string());
  for (int level = 0; input != nullptr && input->seek_subimage(0, level); ++level) {
    Read read{input->spec(), {}};
    read.texels.resize(read.spec.image_pixels() * static_cast<size_t>(read.spec.nchannels));
    EXPECT_TRUE(input->read_image(0, level, 0, -1, OIIO::TypeFloat, read.texels.data()));
    levels.push_back(std::move(read));
  }
  return levels;
}

TEST_F(Readers, OpenImageIoFindsEveryLevelOfAMipMappedOpenExr) {
  const Texture texture = textured({20, 12}, 5, 1, {"R", "G", "B"});
  for (const PixelType type : {PixelType::Half, PixelType::Float}) {
    write_texture(folder / "a.exr", texture, {.type = type});
    const std::vector<Read> levels = levels_of(folder / "a.exr");
    ASSERT_EQ(levels.size(), 5u);
    for (size_t l = 0; l < 5; ++l) {
      const Layers wanted = coded(texture.levels[l][0], type);
      ASSERT_EQ((Size{levels[l].spec.width, levels[l].spec.height}), wanted.size);
      EXPECT_EQ(levels[l].spec.tile_width, 64);
      for (int y = 0; y < wanted.size.height; ++y) {
        for (int x = 0; x < wanted.size.width; ++x) {
          ASSERT_EQ(levels[l].at(x, y, 1), wanted.find("G")->at(x, y)) << l;
        }
      }
    }
  }
}

// A lookup of the whole texture from afar reads its smallest level; one of its middle the largest.
float looked_up(const fs::path& path, float footprint) {
  // The one that the process shares: the library deletes others as if they were of another type.
  OIIO::TextureSystem* system = OIIO::TextureSystem::create(true);
  OIIO::TextureOpt options;
  options.swrap = options.twrap = OIIO::TextureOpt::WrapDefault;  // as the file says
  std::array<float, 3> texel{};
  EXPECT_TRUE(system->texture(OIIO::ustring(path.string()), options, 0.51f, 1.3f, footprint, 0, 0,
                              footprint, 3, texel.data()))
      << system->geterror();
  system->close_all();
  return texel[1];
}

TEST_F(Readers, OpenImageIosTextureSystemReadsTheLevelsOfGrowingTextures) {
  for (const char* name : {"a.exr", "a.tif", "a.tx"}) {
    TextureLayout layout{{100, 70}, 7, {"R", "G", "B"}};
    TextureWriter writer(folder / name, layout, {.type = PixelType::Half});
    Size size = layout.size;
    for (int level = 0; level < 7; ++level) {
      Layers image = make_layers(size, layout.names);
      for (Layer& layer : image.layers) layer.plane = Plane(size, 0.5f + 0.25f * float(level));
      writer.add(level, image);
      size = {std::max(1, size.width / 2), std::max(1, size.height / 2)};
    }
    writer.finish();
    const std::vector<Read> levels = levels_of(folder / name);
    ASSERT_EQ(levels.size(), 7u) << name;
    for (size_t l = 0; l < 7; ++l) {
      EXPECT_EQ(levels[l].spec.width, std::max(1, 100 >> l)) << name;
      EXPECT_EQ(levels[l].spec.tile_width, 64) << name;
      EXPECT_EQ(levels[l].at(0, 0, 2), 0.5f + 0.25f * float(l)) << name;
    }
    EXPECT_EQ(levels[0].spec.get_string_attribute("textureformat"), "Plain Texture") << name;
    EXPECT_EQ(levels[0].spec.get_string_attribute("wrapmodes"), "periodic,periodic") << name;
    EXPECT_EQ(looked_up(folder / name, 1e-4f), 0.5f) << name;
    EXPECT_EQ(looked_up(folder / name, 4.0f), 2.0f) << name;
  }
}

TEST_F(Readers, OpenImageIoKnowsCubesAndLatLongsForEnvironments) {
  write_texture(folder / "a.exr", cube_at_nodes(8, 4, smooth_light),
                {.type = PixelType::Float, .samples = Samples::Nodes});
  const std::vector<Read> faces = levels_of(folder / "a.exr");
  ASSERT_EQ(faces.size(), 6u);
  EXPECT_EQ(faces[0].spec.get_string_attribute("textureformat"), "CubeFace Environment");
  EXPECT_EQ((Size{faces[1].spec.width, faces[1].spec.height}), (Size{4, 24}));
  write_texture(folder / "b.exr", latlong_at_nodes(8, 5, smooth_light),
                {.type = PixelType::Float, .samples = Samples::Nodes});
  const std::vector<Read> maps = levels_of(folder / "b.exr");
  ASSERT_EQ(maps.size(), 5u);
  EXPECT_EQ(maps[0].spec.get_string_attribute("textureformat"), "LatLong Environment");
  EXPECT_EQ(maps[0].at(3, 5, 2),
            read_texture(folder / "b.exr").texture.levels[0][0].find("B")->at(3, 5));
}

TEST_F(Readers, ExrheaderTellsTilesLevelsAndKindOfEnvironment) {
  const std::string tool = program("exrheader");
  if (tool.empty()) GTEST_SKIP() << "no exrheader: Debian's openexr is not installed";
  write_texture(folder / "a.exr", cube_at_nodes(8, 4, smooth_light), {.samples = Samples::Nodes});
  const std::string text = run({tool, (folder / "a.exr").string()}).text;
  for (const char* line : {"envmap (type envmap): cube-face map", "mip-map", "rounded down",
                           "G, 16-bit floating-point", "kiln:levels (type int): 4"}) {
    EXPECT_THAT(text, HasSubstr(line));
  }
}

// OpenEXR's own converter resamples one kind of environment into the other, so that all of both
// mappings must hold; its filter is what the differences come from.
TEST_F(Readers, ExrenvmapTurnsCubesToLatLongsAndBack) {
  const std::string tool = program("exrenvmap");
  if (tool.empty()) GTEST_SKIP() << "no exrenvmap: Debian's openexr is not installed";
  const auto convert = [&](const char* kind, const char* width, const char* from, const char* to) {
    const OutsideOutcome outcome =
        run({tool, kind, "-w", width, (folder / from).string(), (folder / to).string()});
    EXPECT_EQ(outcome.code, 0) << outcome.text;
  };
  write_texture(folder / "cube.exr", cube_at_nodes(64, 7, smooth_light),
                {.type = PixelType::Half, .samples = Samples::Nodes});
  convert("-l", "128", "cube.exr", "map.exr");
  const Layers map = read_texture(folder / "map.exr").texture.levels[0][0];
  ASSERT_EQ(map.size, (Size{128, 64}));
  EXPECT_LT(greatest_difference(latlong_at_nodes(64, 1, smooth_light).levels[0][0], map), 0.01);

  write_texture(folder / "map2.exr", latlong_at_nodes(64, 8, smooth_light),
                {.type = PixelType::Half, .samples = Samples::Nodes});
  convert("-c", "32", "map2.exr", "cube2.exr");
  const Texture back = read_texture(folder / "cube2.exr").texture;
  const Texture wanted = cube_at_nodes(32, 1, smooth_light);
  ASSERT_TRUE(back.is_cube());
  for (size_t f = 0; f < 6; ++f) {
    EXPECT_LT(greatest_difference(wanted.levels[0][f], back.levels[0][f]), 0.01) << f;
  }
}

TEST_F(Readers, NvddsinfoTellsFormatFacesAndLevelsOfDds) {
  const std::string tool = program("nvddsinfo");
  if (tool.empty()) GTEST_SKIP() << "no nvddsinfo: Debian's libnvtt-bin is not installed";
  for (const auto& [type, name] : {std::pair{PixelType::Half, "10 (R16G16B16A16_FLOAT)"},
                                   {PixelType::Float, "2 (R32G32B32A32_FLOAT)"},
                                   {PixelType::B10g11r11, "26 (R11G11B10_FLOAT)"},
                                   {PixelType::E5b9g9r9, "67 (R9G9B9E5_SHAREDEXP)"}}) {
    write_texture(folder / "a.dds", cube(8, 4), {.type = type});
    const std::string text = run({tool, (folder / "a.dds").string()}).text;
    for (const std::string& line :
         {std::string("Mipmap count: 4"), std::string("DDSCAPS2_CUBEMAP_ALL_FACES"),
          "DXGI Format: " + std::string(name), std::string("(TEXTURE2D)"),
          std::string("Array size: 1")}) {
      EXPECT_THAT(text, HasSubstr(line));
    }
  }
}

fs::path readers_folder() { return test::source_folder() / "build/readers"; }

class KtxParse : public Readers {
 protected:
  void SetUp() override {
    node_ = program("node");
    if (node_.empty()) GTEST_SKIP() << "no node";
    if (!fs::is_directory(readers_folder() / "node_modules" / "ktx-parse")) {
      GTEST_SKIP() << "no ktx-parse: scripts/readers.sh puts it into build/readers";
    }
  }

  nlohmann::json parsed(const std::string& name) const {
    const fs::path script = test::source_folder() / "tests/readers/ktx2.mjs";
    const OutsideOutcome outcome =
        run({node_, script.string(), readers_folder().string(), (folder / name).string()});
    EXPECT_EQ(outcome.code, 0) << outcome.text;
    return nlohmann::json::parse(outcome.text, nullptr, false);
  }

  // The n-th number of so many bytes.
  static uint32_t number(const std::string& hex, size_t n, size_t bytes) {
    uint32_t value = 0;
    for (size_t i = bytes; i-- > 0;) {
      const std::string digits = hex.substr(2 * (n * bytes + i), 2);
      value = value << 8 | static_cast<uint32_t>(std::strtoul(digits.c_str(), nullptr, 16));
    }
    return value;
  }

 private:
  std::string node_;
};

TEST_F(KtxParse, FindsWhatEachTypeOfKtx2Holds) {
  struct Case {
    PixelType type;
    int format, type_bytes, texel_bytes;
    size_t samples;
  };
  for (const Case& one :
       {Case{PixelType::Half, 97, 2, 8, 4}, Case{PixelType::Float, 109, 4, 16, 4},
        Case{PixelType::B10g11r11, 122, 4, 4, 3}, Case{PixelType::E5b9g9r9, 123, 4, 4, 6}}) {
    write_texture(folder / "a.ktx2", cube(4, 3),
                  {.type = one.type,
                   .attributes = {{"curve", "filament"}, {"Software", "kiln 1"}},
                   .color_tag = ColorTag::Linear});
    const nlohmann::json found = parsed("a.ktx2");
    EXPECT_EQ(found["format"], one.format);
    EXPECT_EQ(found["type_bytes"], one.type_bytes);
    EXPECT_EQ(found["texel_bytes"], one.texel_bytes);
    EXPECT_EQ(found["samples"].size(), one.samples);
    EXPECT_EQ(found["size"], (std::vector<int>{4, 4, 0}));
    EXPECT_EQ(found["faces"], 6);
    EXPECT_EQ(found["layers"], 0);
    EXPECT_EQ(found["levels"].size(), 3u);
    EXPECT_EQ(found["primaries"], 1);
    EXPECT_EQ(found["transfer"], 1);
    EXPECT_THAT(found["texts"]["KTXorientation"].get<std::string>(), HasSubstr("rd"));
    EXPECT_THAT(found["texts"]["KTXwriter"].get<std::string>(), HasSubstr("kiln 1"));
    EXPECT_THAT(found["texts"]["curve"].get<std::string>(), HasSubstr("filament"));
  }
}

TEST_F(KtxParse, FindsEveryTexelOfEveryLevelAndFace) {
  const Texture texture = cube(4, 3);
  write_texture(folder / "a.ktx2", texture, {.type = PixelType::Float});
  const nlohmann::json found = parsed("a.ktx2");
  for (size_t l = 0; l < 3; ++l) {
    const auto hex = found["levels"][l]["texels"].get<std::string>();
    size_t n = 0;
    for (const Layers& face : texture.levels[l]) {
      for (int y = 0; y < face.size.height; ++y) {
        for (int x = 0; x < face.size.width; ++x) {
          for (size_t c = 0; c < 4; ++c) {
            const float wanted = c == 3 ? 1.0f : face.layers[c].plane.at(x, y);
            ASSERT_EQ(std::bit_cast<float>(number(hex, n++, 4)), wanted) << "level " << l;
          }
        }
      }
    }
    EXPECT_EQ(hex.size(), 8 * n);
  }
}

// Of the shared exponent, decoded here by its definition: mantissa 2^(exponent - 24).
TEST_F(KtxParse, FindsTheSharedExponentWhereTheDescriptorSaysItIs) {
  const Texture texture = cube(2, 1);
  write_texture(folder / "a.ktx2", texture, {.type = PixelType::E5b9g9r9});
  const nlohmann::json found = parsed("a.ktx2");
  const auto hex = found["levels"][0]["texels"].get<std::string>();
  const auto bits_of = [&](uint32_t texel, size_t sample) {
    const nlohmann::json& one = found["samples"][sample];
    return texel >> one["bit"].get<uint32_t>() & ((1u << one["bits"].get<uint32_t>()) - 1);
  };
  for (size_t t = 0; t < 24; ++t) {
    const Layers& face = texture.levels[0][t / 4];
    const auto x = static_cast<int>(t % 2), y = static_cast<int>(t / 2 % 2);
    const uint32_t texel = number(hex, t, 4);
    for (size_t c = 0; c < 3; ++c) {
      const double value =
          std::ldexp(bits_of(texel, 2 * c), static_cast<int>(bits_of(texel, 2 * c + 1)) - 24);
      EXPECT_NEAR(value, face.layers[c].plane.at(x, y), 8.0 / 512);
    }
  }
}

TEST_F(KtxParse, InflatesWhatIsPackedWithZstandardToTheSameTexels) {
  for (const PixelType type : {PixelType::Half, PixelType::B10g11r11}) {
    const Texture texture = cube(16, 5);
    write_texture(folder / "a.ktx2", texture, {.type = type});
    write_texture(folder / "b.ktx2", texture,
                  {.type = type, .supercompression = Supercompression::Zstd});
    const nlohmann::json plain = parsed("a.ktx2"), packed = parsed("b.ktx2");
    EXPECT_EQ(packed["supercompression"], 2);
    EXPECT_EQ(packed["levels"], plain["levels"]);
    EXPECT_EQ(packed["texel_bytes"], plain["texel_bytes"]);
  }
}

}  // namespace
}  // namespace kiln

// SPDX-License-Identifier: Apache-2.0
#include "kiln/io/texture_writer.h"

#include <gmock/gmock.h>

#include <algorithm>

#include "kiln/store/publish.h"
#include "texture_pattern.h"
#include "tiff_directory.h"

namespace kiln {
namespace {

using namespace test;
using testing::HasSubstr;

class GrowingTextures : public ImageFolder {};

Layers rows_of(const Layers& image, int first, int rows) {
  Layers band{{image.size.width, rows}, {}};
  for (const Layer& layer : image.layers) {
    Plane& plane = band.add(layer.name);
    for (int y = 0; y < rows; ++y) {
      const auto row = layer.plane.texels_of_row(first + y);
      std::copy(row.begin(), row.end(), plane.row(y));
    }
  }
  return band;
}

// Values from 0 to 1 in every level.
Texture texture_of(Size size, size_t levels, const std::vector<std::string>& names) {
  Texture texture = textured(size, levels, 1, names);
  for (auto& level : texture.levels) {
    for (Layer& layer : level[0].layers) {
      for (int y = 0; y < level[0].size.height; ++y) {
        for (int x = 0; x < level[0].size.width; ++x) {
          float& v = layer.plane.at(x, y);
          v = v / 50;
          v -= std::floor(v);
        }
      }
    }
  }
  return texture;
}

TextureLayout layout_of(const Texture& texture) {
  TextureLayout layout{texture.levels[0][0].size, static_cast<int>(texture.levels.size()), {}};
  for (const Layer& layer : texture.levels[0][0].layers) layout.names.push_back(layer.name);
  return layout;
}

// As they come of a chain: rows of a level as soon as the one above has what they need.
WriteFacts write_side_by_side(const fs::path& path, const Texture& texture, int band,
                              const TextureWriteOptions& options) {
  TextureWriter writer(path, layout_of(texture), options);
  std::vector<int> written(texture.levels.size());
  const int height = texture.levels[0][0].size.height;
  for (int end = band; end < height + band; end += band) {
    for (size_t l = 0; l < texture.levels.size(); ++l) {
      const Layers& level = texture.levels[l][0];
      const int until = end >= height ? level.size.height : std::min(level.size.height, end >> l);
      if (until == written[l]) continue;
      writer.add(static_cast<int>(l), rows_of(level, written[l], until - written[l]));
      written[l] = until;
    }
  }
  return writer.finish();
}

TEST_F(GrowingTextures, ReturnEveryLevelInEveryTypeHoweverTheRowsCome) {
  for (const WritableTexture& format : growing_textures()) {
    for (const PixelType type : format.types) {
      for (const Size size : {Size{140, 131}, Size{8, 8}, Size{1, 70}, Size{13, 1}}) {
        SCOPED_TRACE(std::string(format.name) + " " + std::string(pixel_type_name(type)));
        const Texture texture = texture_of(size, 2, {"R", "G", "B", "A"});
        const fs::path path = folder / ("x" + std::string(format.extension));
        for (const int band : {1, 16, 64, 131}) {
          EXPECT_EQ(write_side_by_side(path, texture, band, {.type = type}).clamped, 0);
          const TextureFile file = read_texture(path);
          // Of TIFF the first level is read.
          ASSERT_EQ(file.texture.levels.size(), format.name == "tiff" ? 1u : 2u);
          for (size_t l = 0; l < file.texture.levels.size(); ++l) {
            EXPECT_EQ(
                greatest_difference(coded(texture.levels[l][0], type), file.texture.levels[l][0]),
                0)
                << "level " << l;
          }
        }
      }
    }
  }
}

TEST_F(GrowingTextures, KeepMetadataAndAnyChannelsAsTiff) {
  const Texture texture = texture_of({70, 3}, 1, {"height", "R", "slope.x", "slope.y", "G"});
  TextureWriter writer(
      folder / "a.tif", layout_of(texture),
      {.type = PixelType::Half, .attributes = {{"Software", "me"}, {"kiln:method", "vmf"}}});
  writer.add(0, texture.levels[0][0]);
  writer.finish();
  const ImageFile file = read_image(folder / "a.tif");
  EXPECT_EQ(file.image.layers.size(), 5u);
  EXPECT_EQ(file.facts.type, PixelType::Half);
  EXPECT_THAT(file.facts.attributes, testing::IsSupersetOf({testing::Pair("Software", "me"),
                                                            testing::Pair("kiln:method", "vmf")}));
}

// One texel of a byte, in a file that could grow beyond 4 GiB.
TEST_F(GrowingTextures, MayBeBigTiff) {
  publish_stream(folder / "big.tif", [](ByteStream& out) {
    io::TiffDirectories directories(out, true);
    const uint64_t place = out.position();
    out.append("\x33");
    directories.add_long(256, 1);
    directories.add_long(257, 1);
    directories.add_shorts(258, {8});
    directories.add_shorts(259, {1});
    directories.add_shorts(262, {1});
    directories.add_places(273, {place});
    directories.add_shorts(277, {1});
    directories.add_places(279, {1});
    directories.add_text(305, "a text that is longer than eight bytes");
    directories.write();
  });
  const ImageFile file = read_image(folder / "big.tif");
  EXPECT_EQ(file.image.size, (Size{1, 1}));
  EXPECT_EQ(file.image.layers[0].plane.at(0, 0), 0.2f);
  EXPECT_THAT(file.facts.attributes, testing::Contains(testing::Pair(
                                         "Software", "a text that is longer than eight bytes")));
}

TEST_F(GrowingTextures, AreTheFilesThatWholeTexturesMake) {
  const Texture texture = texture_of({100, 80}, 5, {"R", "G"});
  for (const char* name : {"a.ktx2", "a.dds"}) {
    write_side_by_side(folder / name, texture, 16, {.type = PixelType::Half});
    const std::string grown = bytes_of(folder / name);
    write_texture(folder / name, texture, {.type = PixelType::Half});
    EXPECT_TRUE(grown == bytes_of(folder / name)) << name;
  }
}

TEST_F(GrowingTextures, AreTheSameBytesEachTime) {
  const Texture texture = texture_of({100, 80}, 7, {"R", "G", "B"});
  for (const WritableTexture& format : growing_textures()) {
    const fs::path path = folder / ("x" + std::string(format.extension));
    write_side_by_side(path, texture, 16, {.type = format.types.front()});
    const std::string once = bytes_of(path);
    write_side_by_side(path, texture, 16, {.type = format.types.front()});
    EXPECT_TRUE(once == bytes_of(path)) << format.extension;
  }
}

TEST_F(GrowingTextures, SayThatColourIsSrgbWhereBytesAre) {
  const Texture texture = texture_of({8, 8}, 4, {"R", "G", "B"});
  for (const char* name : {"a.ktx2", "a.dds"}) {
    write_side_by_side(folder / name, texture, 8,
                       {.type = PixelType::Uint8, .color_tag = ColorTag::Srgb});
    EXPECT_EQ(read_texture(folder / name).facts.color_space_tag, "srgb_rec709_scene") << name;
    write_side_by_side(folder / name, texture, 8, {.type = PixelType::Uint8});
    EXPECT_NE(read_texture(folder / name).facts.color_space_tag, "srgb_rec709_scene") << name;
  }
}

TEST_F(GrowingTextures, DoNotAppearUnlessTheyAreFinished) {
  const Texture texture = texture_of({8, 8}, 4, {"R"});
  for (const WritableTexture& format : growing_textures()) {
    const fs::path path = folder / ("x" + std::string(format.extension));
    {
      TextureWriter writer(path, layout_of(texture), {.type = format.types.back()});
      writer.add(0, texture.levels[0][0]);
      EXPECT_THROW(writer.finish(), Error);
    }
    EXPECT_FALSE(fs::exists(path));
    EXPECT_TRUE(fs::is_empty(folder));
  }
}

TEST_F(GrowingTextures, RefuseWhatTheirFormatCannotHold) {
  const auto reason = [&](const char* name, const TextureLayout& layout, PixelType type) {
    try {
      const TextureWriter writer(folder / name, layout, {.type = type});
    } catch (const Error& error) {
      EXPECT_EQ(error.fault(), Fault::Usage);
      return std::string(error.what());
    }
    return std::string();
  };
  const TextureLayout one{{4, 4}, 3, {"Y"}};
  EXPECT_THAT(reason("a.exr", one, PixelType::Uint8), HasSubstr("openexr cannot hold uint8"));
  EXPECT_THAT(reason("a.png", one, PixelType::Uint8), HasSubstr(".ktx2"));
  EXPECT_THAT(reason("a.dds", {{4, 4}, 3, {"a", "b", "c", "d", "e"}}, PixelType::Half),
              HasSubstr("1 to 4"));
}

}  // namespace
}  // namespace kiln

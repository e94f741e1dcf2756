// SPDX-License-Identifier: Apache-2.0
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfEnvmap.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfTiledInputFile.h>
#include <OpenEXR/ImfTiledOutputFile.h>
#include <gmock/gmock.h>

#include <cmath>

#include "support/real_data.h"
#include "texture_pattern.h"

// Environments in OpenEXR, against the mappings that OpenEXR itself has for them.
namespace kiln {
namespace {

using namespace test;
using testing::HasSubstr;
using testing::IsEmpty;

Vec3<double> unit(const Imath::V3f& d) {
  const double length = std::sqrt(double(d.x) * d.x + double(d.y) * d.y + double(d.z) * d.z);
  return {d.x / length, d.y / length, d.z / length};
}

// One channel of a level as the library reads it.
struct LevelTexels {
  Imath::Box2i window;
  std::vector<float> texels;

  float at(const Imath::V2f& place) const {
    const int width = window.max.x - window.min.x + 1;
    const int x = static_cast<int>(std::lround(place.x)) - window.min.x;
    const int y = static_cast<int>(std::lround(place.y)) - window.min.y;
    return texels[static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x)];
  }
};

LevelTexels level_texels(Imf::TiledInputFile& file, int level, const char* channel) {
  LevelTexels result{file.dataWindowForLevel(level), {}};
  const int width = result.window.max.x - result.window.min.x + 1;
  const int height = result.window.max.y - result.window.min.y + 1;
  result.texels.resize(static_cast<size_t>(width) * static_cast<size_t>(height));
  Imf::FrameBuffer frame;
  frame.insert(channel, Imf::Slice::Make(Imf::FLOAT, result.texels.data(), result.window.min, width,
                                         height));
  file.setFrameBuffer(frame);
  file.readTiles(0, file.numXTiles(level) - 1, 0, file.numYTiles(level) - 1, level);
  return result;
}

class Envmap : public ImageFolder {};

TEST_F(Envmap, CubesHaveEachSampleWhereOpenExrLooksForItsDirection) {
  constexpr int edge = 16;
  write_texture(folder / "a.exr", cube_at_nodes(edge, all_levels(edge), smooth_light),
                {.type = PixelType::Float, .samples = Samples::Nodes});
  Imf::TiledInputFile file((folder / "a.exr").c_str(), 0);
  ASSERT_TRUE(Imf::hasEnvmap(file.header()));
  EXPECT_EQ(Imf::envmap(file.header()), Imf::ENVMAP_CUBE);
  for (int level = 0; level < 5; ++level) {
    const char* names[] = {"R", "G", "B"};
    for (size_t c = 0; c < 3; ++c) {
      const LevelTexels stored = level_texels(file, level, names[c]);
      const int n = Imf::CubeMap::sizeOfFace(stored.window);
      ASSERT_EQ(n, edge >> level);
      for (int f = 0; f < 6; ++f) {
        const auto face = static_cast<Imf::CubeMapFace>(f);
        for (int y = 0; y < n; ++y) {
          for (int x = 0; x < n; ++x) {
            const Imath::V2f in_face(static_cast<float>(x), static_cast<float>(y));
            const Vec3<double> d = unit(Imf::CubeMap::direction(face, stored.window, in_face));
            const Imath::V2f place = Imf::CubeMap::pixelPosition(face, stored.window, in_face);
            ASSERT_NEAR(stored.at(place), smooth_light(d, c), 2e-6)
                << "face " << f << " at " << x << " " << y << " level " << level;
          }
        }
      }
    }
  }
}

TEST_F(Envmap, LatLongsHaveEachSampleWhereOpenExrLooksForItsDirection) {
  write_texture(folder / "a.exr", latlong_at_nodes(16, 6, smooth_light),
                {.type = PixelType::Float, .samples = Samples::Nodes});
  Imf::TiledInputFile file((folder / "a.exr").c_str(), 0);
  EXPECT_EQ(Imf::envmap(file.header()), Imf::ENVMAP_LATLONG);
  for (int level = 0; level < 4; ++level) {
    const LevelTexels stored = level_texels(file, level, "G");
    for (int y = 0; y <= stored.window.max.y; ++y) {
      for (int x = 0; x <= stored.window.max.x; ++x) {
        const Imath::V2f place(static_cast<float>(x), static_cast<float>(y));
        const Vec3<double> d = unit(Imf::LatLongMap::direction(stored.window, place));
        ASSERT_NEAR(stored.at(place), smooth_light(d, 1), 2e-6) << x << " " << y << " of " << level;
      }
    }
  }
}

TEST_F(Envmap, LevelsThatATextureLacksAreAveragesOfItsLast) {
  Texture texture = cube_at_nodes(8, 2, [](const Vec3<double>&, size_t) { return 1.0f; });
  for (Layers& face : texture.levels[1]) {
    for (int x = 0; x < 4; ++x) face.layers[0].plane.at(x, 2) = 3;
  }
  write_texture(folder / "a.exr", texture, {.type = PixelType::Float, .samples = Samples::Nodes});
  Imf::TiledInputFile file((folder / "a.exr").c_str(), 0);
  ASSERT_EQ(file.numLevels(), 6);  // 8 x 48 halves to 1 x 1 in six
  EXPECT_TRUE(file.isComplete());
  for (int level = 2; level < 6; ++level) {
    double sum = 0;
    const LevelTexels stored = level_texels(file, level, "R");
    for (const float value : stored.texels) sum += value;
    EXPECT_NEAR(sum / static_cast<double>(stored.texels.size()), 1.5, 1e-6) << level;
  }
  EXPECT_EQ(read_texture(folder / "a.exr").texture.levels.size(), 2u);
}

TEST_F(Envmap, ImagesAreNoEnvironments) {
  write_texture(folder / "a.exr", textured({8, 4}, 4, 1, {"R"}), {});
  Imf::TiledInputFile file((folder / "a.exr").c_str(), 0);
  EXPECT_FALSE(Imf::hasEnvmap(file.header()));
  EXPECT_EQ(file.header().tileDescription().mode, Imf::MIPMAP_LEVELS);
  EXPECT_FALSE(read_texture(folder / "a.exr").facts.node_aligned);
  EXPECT_EQ(read_image(folder / "a.exr").image.size, (Size{8, 4}));
}

TEST_F(Envmap, LevelsThatAreRoundedUpAreLeftOut) {
  Imf::Header header(5, 5);
  header.setTileDescription(Imf::TileDescription(8, 8, Imf::MIPMAP_LEVELS, Imf::ROUND_UP));
  header.channels().insert("Y", Imf::Channel(Imf::FLOAT));
  {
    Imf::TiledOutputFile file((folder / "a.exr").c_str(), header, 0);
    std::vector<float> texels(25, 1);
    Imf::FrameBuffer frame;
    frame.insert("Y", Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(texels.data()), 4, 20));
    file.setFrameBuffer(frame);
    for (int level = 0; level < file.numLevels(); ++level) file.writeTile(0, 0, level);
  }
  const TextureFile file = read_texture(folder / "a.exr");
  EXPECT_EQ(file.texture.levels.size(), 1u);
  EXPECT_THAT(file.facts.notes, testing::ElementsAre(HasSubstr("4 levels; the first 1 is read")));
}

TEST_F(Envmap, TruncatedTexturesAreRefused) {
  write_texture(folder / "a.exr", textured({64, 64}, 7, 1, {"R"}), {});
  const std::string bytes = bytes_of(folder / "a.exr");
  const fs::path cut = write_bytes("b.exr", bytes.substr(0, bytes.size() / 2));
  EXPECT_THAT(fault_text(Fault::Input, [&] { read_texture(cut); }), HasSubstr("b.exr: "));
}

enum class Turned { No, Mirrored, UpsideDown };

// Of samples of the faces and of what the lat-long holds nearest to their directions.
double mean_difference(const std::vector<Layers>& faces, const Layers& map, Turned turned) {
  const int n = faces[0].size.width;
  double sum = 0, count = 0;
  for (size_t f = 0; f < 6; ++f) {
    for (int y = 8; y < n; y += 16) {
      for (int x = 8; x < n; x += 16) {
        const Vec3<double> d =
            cube_to_direction(static_cast<CubeFace>(f), Vec2<double>{x / (n - 1.0), y / (n - 1.0)});
        const Vec2<double> uv = direction_to_latlong(d);
        const auto column = static_cast<int>(std::lround(uv.x * (map.size.width - 1)));
        const auto row = static_cast<int>(std::lround(uv.y * (map.size.height - 1)));
        const int from_x = turned == Turned::Mirrored ? n - 1 - x : x;
        const int from_y = turned == Turned::UpsideDown ? n - 1 - y : y;
        sum += std::abs(double(faces[f].find("G")->at(from_x, from_y)) -
                        map.find("G")->at(column, row));
        ++count;
      }
    }
  }
  return sum / count;
}

// OpenEXR's own examples: one environment as a cube and as a lat-long.
TEST_F(Envmap, RealCubesAndLatLongsShowTheSameLight) {
  KILN_REQUIRE_REAL_DATA(data);
  for (const char* name : {"Orientation", "WavyLines"}) {
    const std::string stem = (data / "data/env" / name).string();
    const TextureFile cube_file = read_texture(stem + "Cube.exr");
    const TextureFile map_file = read_texture(stem + "LatLong.exr");
    ASSERT_TRUE(cube_file.texture.is_cube()) << name;
    EXPECT_TRUE(cube_file.facts.node_aligned && map_file.facts.node_aligned);
    EXPECT_THAT(cube_file.facts.notes, IsEmpty());
    const Layers& map = map_file.texture.levels[0][0];
    const double as_read = mean_difference(cube_file.texture.levels[0], map, Turned::No);
    EXPECT_LT(as_read, 0.05) << name;
    EXPECT_LT(3 * as_read, mean_difference(cube_file.texture.levels[0], map, Turned::Mirrored));
    EXPECT_LT(3 * as_read, mean_difference(cube_file.texture.levels[0], map, Turned::UpsideDown));
  }
}

}  // namespace
}  // namespace kiln

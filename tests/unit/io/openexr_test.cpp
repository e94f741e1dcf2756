// SPDX-License-Identifier: Apache-2.0
#include <OpenEXR/ImfArray.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfRgbaFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfTiledOutputFile.h>
#include <gmock/gmock.h>

#include <cmath>

#include "image_folder.h"

namespace kiln {
namespace {

using namespace test;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

class OpenExr : public ImageFolder {
 protected:
  // One float channel Y over a data window, each texel 100 y + x in the file's own coordinates.
  fs::path write_y(const std::string& name, Imf::Header header) const {
    const fs::path path = folder / name;
    const Imath::Box2i window = header.dataWindow();
    header.channels().insert("Y", Imf::Channel(Imf::FLOAT));
    const std::vector<float> texels = coordinates(window);
    Imf::OutputFile file(path.c_str(), header, 0);
    file.setFrameBuffer(frame(texels, window));
    file.writePixels(window.max.y - window.min.y + 1);
    return path;
  }
  static std::vector<float> coordinates(const Imath::Box2i& window) {
    std::vector<float> texels;
    for (int y = window.min.y; y <= window.max.y; ++y) {
      for (int x = window.min.x; x <= window.max.x; ++x) {
        texels.push_back(static_cast<float>(100 * y + x));
      }
    }
    return texels;
  }
  static Imf::FrameBuffer frame(const std::vector<float>& texels, const Imath::Box2i& window) {
    Imf::FrameBuffer result;
    result.insert("Y", Imf::Slice::Make(Imf::FLOAT, texels.data(), window));
    return result;
  }
};

TEST_F(OpenExr, ReturnsTheDisplayWindowWithZeroWhereThereIsNoData) {
  const Imath::Box2i shown({0, 0}, {9, 7});
  const Imath::Box2i stored({-3, 2}, {5, 90});
  const ImageFile file = read_image(write_y("a.exr", Imf::Header(shown, stored)));
  ASSERT_EQ(file.image.size, (Size{10, 8}));
  const Plane& y = *file.image.find("Y");
  EXPECT_EQ(y.at(0, 0), 0);
  EXPECT_EQ(y.at(9, 7), 0);
  EXPECT_EQ(y.at(6, 3), 0);
  EXPECT_EQ(y.at(0, 2), 200);
  EXPECT_EQ(y.at(5, 7), 705);
  EXPECT_THAT(file.facts.notes, Contains(HasSubstr("data window (-3, 2)-(5, 90) differs")));
}

TEST_F(OpenExr, ReturnsZeroWhereTheWindowsDoNotMeet) {
  const ImageFile file = read_image(write_y(
      "a.exr", Imf::Header(Imath::Box2i({0, 0}, {3, 3}), Imath::Box2i({50, 50}, {60, 60}))));
  EXPECT_EQ(file.image.size, (Size{4, 4}));
  EXPECT_EQ(file.image.find("Y")->at(2, 2), 0);
}

TEST_F(OpenExr, ReadsADisplayWindowThatStartsElsewhere) {
  const Imath::Box2i window({-4, -2}, {-1, 1});
  const ImageFile file = read_image(write_y("a.exr", Imf::Header(window, window)));
  EXPECT_EQ(file.image.find("Y")->at(0, 0), -204);
  EXPECT_EQ(file.image.find("Y")->at(3, 3), 99);
  EXPECT_TRUE(file.facts.notes.empty());
}

TEST_F(OpenExr, ReadsTheLargestLevelOfTiledMips) {
  Imf::Header header(70, 50);
  header.channels().insert("Y", Imf::Channel(Imf::FLOAT));
  header.setTileDescription(Imf::TileDescription(16, 24, Imf::MIPMAP_LEVELS));
  const Imath::Box2i window = header.dataWindow();
  const std::vector<float> texels = coordinates(window);
  const fs::path path = folder / "a.exr";
  {
    Imf::TiledOutputFile file(path.c_str(), header, 0);
    for (int level = 0; level < file.numLevels(); ++level) {
      file.setFrameBuffer(frame(texels, window));
      file.writeTiles(0, file.numXTiles(level) - 1, 0, file.numYTiles(level) - 1, level);
    }
  }
  const Plane y = *read_image(path).image.find("Y");
  EXPECT_EQ(y.size(), (Size{70, 50}));
  for (int row = 0; row < 50; ++row) {
    for (int x = 0; x < 70; ++x) ASSERT_EQ(y.at(x, row), 100 * row + x);
  }
}

TEST_F(OpenExr, ReadsTheFirstOfSeveralParts) {
  std::vector<Imf::Header> headers(2, Imf::Header(6, 5));
  const fs::path path = folder / "a.exr";
  const std::vector<float> texels = coordinates(headers[0].dataWindow());
  const std::vector<float> zeros(30, 0.0f);
  for (size_t i = 0; i < 2; ++i) {
    headers[i].setName(i == 0 ? "beauty" : "depth");
    headers[i].setType(Imf::SCANLINEIMAGE);
    headers[i].channels().insert("Y", Imf::Channel(Imf::FLOAT));
  }
  {
    Imf::MultiPartOutputFile file(path.c_str(), headers.data(), 2, false, 0);
    for (int i = 0; i < 2; ++i) {
      Imf::OutputPart part(file, i);
      part.setFrameBuffer(frame(i == 0 ? texels : zeros, headers[0].dataWindow()));
      part.writePixels(5);
    }
  }
  const ImageFile file = read_image(path);
  EXPECT_EQ(file.image.find("Y")->at(5, 4), 405);
  EXPECT_THAT(file.facts.notes, Contains(HasSubstr("2 parts; the first is read")));
}

TEST_F(OpenExr, RefusesDeepData) {
  Imf::Header header(4, 4);
  header.setType(Imf::DEEPSCANLINE);
  header.setName("deep");
  header.compression() = Imf::ZIPS_COMPRESSION;
  header.channels().insert("Z", Imf::Channel(Imf::FLOAT));
  { Imf::MultiPartOutputFile file((folder / "a.exr").c_str(), &header, 1, false, 0); }
  EXPECT_THAT(fault_text(Fault::Input, [&] { read_image(folder / "a.exr"); }),
              HasSubstr("a.exr: holds deep data, expected flat pixels"));
}

TEST_F(OpenExr, RefusesSubsampledChroma) {
  const fs::path path = folder / "a.exr";
  {
    const std::vector<Imf::Rgba> texels(64, Imf::Rgba(0.5f, 0.25f, 0.125f));
    Imf::RgbaOutputFile file(path.c_str(), 8, 8, Imf::WRITE_YC, 1, {0, 0}, 1, Imf::INCREASING_Y,
                             Imf::ZIP_COMPRESSION, 0);
    file.setFrameBuffer(texels.data(), 1, 8);
    file.writePixels(8);
  }
  EXPECT_THAT(fault_text(Fault::Input, [&] { inspect_image(path); }),
              HasSubstr("subsampled 2 x 2"));
}

TEST_F(OpenExr, KeepsEveryChannelUnderItsFullName) {
  const Layers image = pattern({5, 4}, {"stderr.R", "B", "A", "diffuse.G", "R", "G"});
  write_image(folder / "a.exr", image, {.type = PixelType::Float});
  const ImageFile file = read_image(folder / "a.exr");
  EXPECT_THAT(channel_names(file.image), ElementsAre("R", "G", "B", "A", "diffuse.G", "stderr.R"));
  for (const Layer& layer : image.layers) {
    EXPECT_EQ(file.image.find(layer.name)->at(3, 2), layer.plane.at(3, 2)) << layer.name;
  }
}

TEST_F(OpenExr, KeepsNanAndInfAndDenormals) {
  Layers image = make_layers({4, 1}, {"Y"});
  const float values[] = {NAN, -INFINITY, 5.9604645e-8f, -0.0f};
  for (int x = 0; x < 4; ++x) image.layers[0].plane.at(x, 0) = values[x];
  for (const PixelType type : {PixelType::Half, PixelType::Float}) {
    const WriteFacts facts = write_image(folder / "a.exr", image, {.type = type});
    EXPECT_EQ(facts.clamped, 0);
    const Plane y = *read_image(folder / "a.exr").image.find("Y");
    EXPECT_TRUE(std::isnan(y.at(0, 0)));
    EXPECT_EQ(y.at(1, 0), -INFINITY);
    EXPECT_EQ(y.at(2, 0), values[2]);
    EXPECT_TRUE(std::signbit(y.at(3, 0)));
  }
}

TEST_F(OpenExr, TellsWhereColoursComeFrom) {
  const Imath::V2f aces_white(0.32168f, 0.33767f);
  Imf::Header header(2, 2);
  EXPECT_EQ(read_image(write_y("plain.exr", header)).facts.color_space_tag, std::nullopt);
  Imf::addChromaticities(header, Imf::Chromaticities());
  EXPECT_EQ(read_image(write_y("709.exr", header)).facts.color_space_tag, "lin_rec709_scene");
  Imf::addChromaticities(
      header, Imf::Chromaticities({0.713f, 0.293f}, {0.165f, 0.83f}, {0.128f, 0.044f}, aces_white));
  const FileFacts ap1 = read_image(write_y("ap1.exr", header)).facts;
  EXPECT_EQ(ap1.color_space_tag, "lin_ap1_scene");
  EXPECT_THAT(ap1.notes, Contains(HasSubstr("chromaticities are not Rec.709")));
  Imf::addChromaticities(
      header, Imf::Chromaticities({0.6f, 0.3f}, {0.2f, 0.7f}, {0.1f, 0.1f}, {0.3127f, 0.329f}));
  const FileFacts odd = read_image(write_y("odd.exr", header)).facts;
  EXPECT_EQ(odd.color_space_tag, std::nullopt);
  EXPECT_THAT(odd.notes, Contains(HasSubstr("red 0.6 0.3")));
}

TEST_F(OpenExr, TakesLatLongEnvironmentsAsNodeAligned) {
  Imf::Header header(4, 2);
  EXPECT_FALSE(read_image(write_y("plain.exr", header)).facts.node_aligned);
  Imf::addEnvmap(header, Imf::ENVMAP_LATLONG);
  EXPECT_TRUE(read_image(write_y("latlong.exr", header)).facts.node_aligned);
  EXPECT_TRUE(inspect_image(folder / "latlong.exr").node_aligned);
  EXPECT_EQ(inspect_image(folder / "latlong.exr").envmap, Envmap::LatLong);
}

TEST_F(OpenExr, SaysThatAFileIsACubeWithSamplesOnItsBorders) {
  Imf::Header header(2, 12);
  Imf::addEnvmap(header, Imf::ENVMAP_CUBE);
  const FileFacts facts = inspect_image(write_y("cube.exr", header));
  EXPECT_EQ(facts.envmap, Envmap::Cube);
  EXPECT_TRUE(facts.node_aligned);
}

TEST_F(OpenExr, PremultipliesOnlyWhenAsked) {
  Layers image = make_layers({1, 1}, {"R", "G", "B", "A"});
  const float values[] = {1, 0.5f, 0.25f, 0.5f};
  for (size_t c = 0; c < 4; ++c) image.layers[c].plane.at(0, 0) = values[c];
  image.add("stderr.R", 1);
  write_image(folder / "a.exr", image, {.type = PixelType::Float});
  const ImageFile straight = read_image(folder / "a.exr");
  EXPECT_EQ(straight.image.find("G")->at(0, 0), 0.5f);
  EXPECT_THAT(straight.facts.notes, Contains(HasSubstr("alpha is not 1 everywhere")));
  write_image(folder / "b.exr", image,
              {.type = PixelType::Float, .alpha = AlphaStorage::Premultiplied});
  const ImageFile custom = read_image(folder / "b.exr");
  EXPECT_EQ(custom.image.find("G")->at(0, 0), 0.25f);
  EXPECT_EQ(custom.image.find("A")->at(0, 0), 0.5f);
  EXPECT_EQ(custom.image.find("stderr.R")->at(0, 0), 1);
}

TEST_F(OpenExr, WritesBlocksOfLinesAsTheLibraryReadsThem) {
  const std::string name(60, 'n');
  for (const PixelType type : {PixelType::Half, PixelType::Float}) {
    Layers image = pattern({37, 53}, {"R", name, "B"});
    image.layers[0].plane = Plane(image.size, 0.25f);
    for (int x = 0; x < 37; ++x)
      image.layers[2].plane.at(x, 50) = std::sin(1e4f * static_cast<float>(x));
    write_image(folder / "a.exr", image, {.type = type, .attributes = {{name, "text"}}});
    Imf::InputFile file((folder / "a.exr").c_str());
    EXPECT_TRUE(file.isComplete());
    EXPECT_EQ(file.header().compression(), Imf::ZIP_COMPRESSION);
    EXPECT_NE(file.header().find(name), file.header().end());
    for (const Layer& layer : coded(image, type).layers) {
      Plane read(image.size);
      Imf::FrameBuffer frame;
      frame.insert(layer.name, Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(read.row(0)),
                                          sizeof(float), sizeof(float) * read.stride()));
      file.setFrameBuffer(frame);
      file.readPixels(0, 52);
      for (int y = 0; y < 53; ++y) {
        for (int x = 0; x < 37; ++x) ASSERT_EQ(read.at(x, y), layer.plane.at(x, y));
      }
    }
  }
}

TEST_F(OpenExr, PacksBlocksSideBySideToTheSameBytes) {
  const Layers image = pattern({37, 400}, {"R", "G", "B"});
  WriteOptions options;
  write_image(folder / "one.exr", image, options);
  options.run = [](int count, const std::function<void(int)>& task) {
    for (int i = count - 1; i >= 0; --i) task(i);
  };
  write_image(folder / "other.exr", image, options);
  EXPECT_TRUE(bytes_of(folder / "one.exr") == bytes_of(folder / "other.exr"));
}

TEST_F(OpenExr, RefusesMetadataThatIsTheFormatsOwn) {
  for (const char* name : {"compression", "channels", ""}) {
    fault_text(Fault::Usage, [&] {
      write_image(folder / "a.exr", pattern({2, 2}, {"Y"}), {.attributes = {{name, "x"}}});
    });
  }
  EXPECT_TRUE(names().empty());
}

TEST_F(OpenExr, RefusesAChannelTwice) {
  Layers image = pattern({2, 2}, {"Y"});
  image.add("Y");
  EXPECT_THAT(fault_text(Fault::Usage, [&] { write_image(folder / "a.exr", image, {}); }),
              HasSubstr("channel name 'Y' is empty or used twice"));
}

}  // namespace
}  // namespace kiln

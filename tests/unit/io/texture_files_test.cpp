// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <csignal>

#include "crafted_files.h"
#include "texture_pattern.h"

namespace kiln {
namespace {

using namespace test;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Pair;

std::string file_of(const WritableTexture& format) { return "x" + std::string(format.extension); }

// What a format wants besides the type.
TextureWriteOptions options_for(const WritableTexture& format, PixelType type, bool is_cube) {
  TextureWriteOptions options{.type = type};
  if (format.name == "openexr" && is_cube) options.samples = Samples::Nodes;
  return options;
}

class TextureFiles : public ImageFolder {
 protected:
  // Compares every level and face of what is read with what a reader of the type gets.
  static void expect_same(const Texture& texture, PixelType type, const TextureFile& file) {
    ASSERT_EQ(file.texture.levels.size(), texture.levels.size());
    for (size_t l = 0; l < texture.levels.size(); ++l) {
      ASSERT_EQ(file.texture.levels[l].size(), texture.levels[l].size()) << "level " << l;
      for (size_t f = 0; f < texture.levels[l].size(); ++f) {
        const Layers wanted = coded(texture.levels[l][f], type);
        EXPECT_EQ(greatest_difference(wanted, file.texture.levels[l][f]), 0)
            << "level " << l << " face " << f;
      }
    }
    EXPECT_EQ(file.facts.size, texture.levels[0][0].size);
    EXPECT_EQ(file.facts.channels, channel_names(file.texture.levels[0][0]));
    EXPECT_EQ(file.stored, type);
    EXPECT_THAT(file.facts.notes, IsEmpty());
  }
};

TEST_F(TextureFiles, ReturnEveryLevelAndFaceInEveryFormatAndType) {
  for (const WritableTexture& format : writable_textures()) {
    for (const PixelType type : format.types) {
      for (const size_t faces : {1, 6}) {
        if (faces == 1 && !format.holds_images) continue;
        SCOPED_TRACE(std::string(format.name) + " " + std::string(pixel_type_name(type)) + " x" +
                     std::to_string(faces));
        const Texture texture = textured({8, 8}, 4, faces, {"R", "G", "B"});
        const WriteFacts facts =
            write_texture(folder / file_of(format), texture, options_for(format, type, faces == 6));
        EXPECT_EQ(facts.clamped, 0);
        const TextureFile file = read_texture(folder / file_of(format));
        expect_same(texture, type, file);
        EXPECT_EQ(file.facts.format, format.name);
        EXPECT_EQ(file.facts.node_aligned, format.name == "openexr" && faces == 6);
      }
    }
  }
}

TEST_F(TextureFiles, HoldOddSizesAndPartOfTheLevels) {
  for (const WritableTexture& format : writable_textures()) {
    if (!format.holds_images) continue;
    for (const PixelType type : format.types) {
      SCOPED_TRACE(std::string(format.name) + " " + std::string(pixel_type_name(type)));
      for (const Size size : {Size{13, 6}, Size{1, 5}, Size{3, 1}}) {
        const Texture texture = textured(size, 2, 1, {"R", "G", "B"});
        write_texture(folder / file_of(format), texture, {.type = type});
        expect_same(texture, type, read_texture(folder / file_of(format)));
      }
    }
  }
}

TEST_F(TextureFiles, HoldCubesOfAnySizeWhereLevelsNeedNotHalveTogether) {
  for (const WritableTexture& format : writable_textures()) {
    if (format.name == "env") continue;
    const size_t levels = format.name == "openexr" ? 1 : 3;
    const Texture texture = cube(7, levels);
    write_texture(folder / file_of(format), texture, options_for(format, PixelType::Half, true));
    SCOPED_TRACE(format.name);
    expect_same(texture, PixelType::Half, read_texture(folder / file_of(format)));
  }
}

TEST_F(TextureFiles, HoldOneToFourChannels) {
  for (const WritableTexture& format : writable_textures()) {
    if (format.name == "env") continue;
    for (const auto& names : {std::vector<std::string>{"Y"}, {"R", "G"}, {"R", "G", "B", "A"}}) {
      const Texture texture = cube(4, 3, names);
      write_texture(folder / file_of(format), texture, options_for(format, PixelType::Half, true));
      SCOPED_TRACE(std::string(format.name) + std::to_string(names.size()));
      const TextureFile file = read_texture(folder / file_of(format));
      EXPECT_EQ(file.facts.channels, names);
      expect_same(texture, PixelType::Half, file);
    }
  }
}

TEST_F(TextureFiles, ThreeChannelsOfWholeSamplesGetAnAlphaOfOne) {
  for (const char* name : {"x.ktx2", "x.ktx", "x.dds"}) {
    for (const PixelType type : {PixelType::Half, PixelType::Float}) {
      write_texture(folder / name, cube(2, 1), {.type = type});
      const Layers face = read_texture(folder / name).texture.levels[0][5];
      EXPECT_THAT(channel_names(face), ElementsAre("R", "G", "B", "A"));
      EXPECT_EQ(face.find("A")->at(1, 1), 1);
    }
  }
}

TEST_F(TextureFiles, OpenExrKeepsAllChannelsByName) {
  const Texture texture = cube(4, 3, {"R", "G", "B", "A", "stderr.R"});
  write_texture(folder / "x.exr", texture, {.type = PixelType::Float, .samples = Samples::Nodes});
  expect_same(texture, PixelType::Float, read_texture(folder / "x.exr"));
}

TEST_F(TextureFiles, KeepTextMetadataWhereTheFormatHoldsIt) {
  const Attributes attributes{{"Software", "kiln 1"}, {"curve", "filament"}};
  for (const WritableTexture& format : writable_textures()) {
    TextureWriteOptions options = options_for(format, format.types.front(), true);
    options.attributes = attributes;
    write_texture(folder / file_of(format), cube(4, 3), options);
    const Attributes found = read_texture(folder / file_of(format)).facts.attributes;
    for (const auto& attribute : attributes) {
      if (format.holds_attributes) {
        EXPECT_THAT(found, Contains(attribute)) << format.name;
      } else {
        EXPECT_THAT(found, IsEmpty()) << format.name;
      }
    }
  }
}

TEST_F(TextureFiles, AreTheSameBytesTwiceAndCarryNoDate) {
  for (const WritableTexture& format : writable_textures()) {
    for (const PixelType type : format.types) {
      const fs::path first = folder / file_of(format), second = folder / "b" / file_of(format);
      write_texture(first, cube(4, 3), options_for(format, type, true));
      write_texture(second, cube(4, 3), options_for(format, type, true));
      EXPECT_EQ(bytes_of(first), bytes_of(second)) << format.name << " " << pixel_type_name(type);
      EXPECT_EQ(bytes_of(first).find("capDate"), std::string::npos);
    }
  }
}

TEST_F(TextureFiles, CountWhatTheirTypesCannotHold) {
  Texture texture = cube(1, 1);
  Layers& face = texture.levels[0][2];
  face.layers[0].plane.at(0, 0) = 70000;
  face.layers[1].plane.at(0, 0) = -3;
  face.layers[2].plane.at(0, 0) = NAN;
  struct Count {
    const char* name;
    PixelType type;
    int clamped, not_a_number;
  };
  for (const Count& one : {Count{"a.ktx2", PixelType::Half, 1, 0},
                           {"a.ktx2", PixelType::B10g11r11, 2, 1},
                           {"a.dds", PixelType::E5b9g9r9, 2, 1},
                           {"a.ktx", PixelType::B10g11r11, 2, 1},
                           {"a.env", PixelType::Rgbd8, 2, 1},
                           {"a.dds", PixelType::Float, 0, 0}}) {
    const WriteFacts facts = write_texture(folder / one.name, texture, {.type = one.type});
    EXPECT_EQ(facts.clamped, one.clamped) << one.name;
    EXPECT_EQ(facts.not_a_number, one.not_a_number) << one.name;
    EXPECT_EQ(facts.largest_clamped, one.clamped > 0 ? 70000 : 0) << one.name;
  }
}

TEST_F(TextureFiles, AreImagesOfTheFirstFaceToReadImage) {
  for (const WritableTexture& format : writable_textures()) {
    if (format.name == "openexr") continue;
    const PixelType type = format.types.front();
    const Texture texture = cube(4, 3);
    const fs::path path = folder / file_of(format);
    write_texture(path, texture, {.type = type});
    const ImageFile file = read_image(path);
    EXPECT_EQ(greatest_difference(coded(texture.levels[0][0], type), file.image), 0);
    EXPECT_THAT(file.facts.notes,
                ElementsAre("a cube; its first face is read", "3 mip levels; the largest is read"))
        << format.name;
    EXPECT_EQ(inspect_image(path).notes, file.facts.notes);
    EXPECT_EQ(inspect_image(path).size, (Size{4, 4}));
  }
}

TEST_F(TextureFiles, OfOtherKindsAreOneLevelOfOneImage) {
  write_image(folder / "a.png", pattern({5, 3}, {"R", "G", "B"}), {.type = PixelType::Uint8});
  const TextureFile file = read_texture(folder / "a.png");
  ASSERT_EQ(file.texture.levels.size(), 1u);
  EXPECT_EQ(file.texture.levels[0].size(), 1u);
  EXPECT_EQ(file.facts.size, (Size{5, 3}));
  EXPECT_EQ(file.stored, PixelType::Uint8);
}

TEST_F(TextureFiles, OfVolumesAreRefused) {
  for (const char* name : {"v.dds", "v.ktx2"}) {
    write_image(folder / name, pattern({4, 8}, {"R"}), {.type = PixelType::Half, .depth = 2});
    EXPECT_THAT(fault_text(Fault::Input, [&] { read_texture(folder / name); }),
                HasSubstr("a volume of 2 slices, expected a texture"));
  }
}

TEST_F(TextureFiles, AreRefusedBeyondTheLimitsInAllLevelsAndFaces) {
  for (const WritableTexture& format : writable_textures()) {
    const fs::path path = folder / file_of(format);
    write_texture(path, cube(4, 3), options_for(format, format.types.front(), true));
    EXPECT_EQ(read_texture(path, {.max_texels = 126}).texture.levels.size(), 3u);
    EXPECT_THAT(fault_text(Fault::Input, [&] { read_texture(path, {.max_texels = 125}); }),
                HasSubstr("more than 125"))
        << format.name;
  }
}

// A header alone must not cost memory: 2^14 x 2^14 texels in six faces are claimed by a few bytes.
TEST_F(TextureFiles, OfFewBytesThatClaimManyTexelsAreRefused) {
  for (const Supercompression packing : {Supercompression::None, Supercompression::Zstd}) {
    write_texture(folder / "a.ktx2", cube(1, 1), {.supercompression = packing});
    std::string bytes = bytes_of(folder / "a.ktx2");
    for (const size_t at : {20, 24}) bytes.replace(at, 4, little_endian(1 << 14, 4));
    bytes.replace(96, 8, little_endian(0, 4) + little_endian(3, 4));
    const fs::path crafted = write_bytes("b.ktx2", bytes);
    const ReadLimits large{.max_texels = 1LL << 40};
    EXPECT_THAT(fault_text(Fault::Input, [&] { read_texture(crafted, large); }),
                HasSubstr("truncated: the header claims"));
    EXPECT_THAT(fault_text(Fault::Input, [&] { read_image(crafted, large); }),
                HasSubstr("truncated: the header claims"));
  }
}

TEST_F(TextureFiles, WithMoreLevelsThanTheirSizeHasAreRefused) {
  write_texture(folder / "a.ktx2", cube(4, 3), {});
  std::string bytes = bytes_of(folder / "a.ktx2");
  bytes[40] = 4;
  EXPECT_THAT(fault_text(Fault::Input, [&] { read_texture(write_bytes("b.ktx2", bytes)); }),
              HasSubstr("claims 4 mip levels of 4 x 4 texels, which have 1 to 3"));
}

class TextureFaults : public ImageFolder {
 protected:
  std::string usage(const std::string& name, const Texture& texture,
                    const TextureWriteOptions& options) const {
    const std::string text =
        fault_text(Fault::Usage, [&] { write_texture(folder / name, texture, options); });
    EXPECT_EQ(text.rfind((folder / name).string() + ": ", 0), 0u) << text;
    EXPECT_FALSE(fs::exists(folder / name));
    return text;
  }
};

TEST_F(TextureFaults, NameTheExtensionsThatAreKnown) {
  EXPECT_THAT(usage("a.tif", cube(2, 1), {}),
              HasSubstr("unknown file extension '.tif' (known: .ktx2, .ktx, .dds, .exr, .env)"));
}

TEST_F(TextureFaults, NameTheTypesThatAFormatHolds) {
  for (const WritableTexture& format : writable_textures()) {
    for (const PixelType type : {PixelType::Uint8, PixelType::Half, PixelType::Float,
                                 PixelType::Rgbd8, PixelType::B10g11r11, PixelType::E5b9g9r9}) {
      if (std::count(format.types.begin(), format.types.end(), type) > 0) continue;
      EXPECT_THAT(usage(file_of(format), cube(2, 2), options_for(format, type, true)),
                  HasSubstr(std::string(format.name) + " cannot hold " +
                            std::string(pixel_type_name(type)) + "; it holds "));
    }
  }
}

TEST_F(TextureFaults, SayWhatEachFormatWants) {
  const TextureWriteOptions nodes{.samples = Samples::Nodes};
  EXPECT_THAT(usage("a.dds", cube(2, 2), {.supercompression = Supercompression::Zstd}),
              HasSubstr("dds has no supercompression; ktx2 has zstd"));
  EXPECT_THAT(usage("a.ktx2", cube(2, 2), nodes), HasSubstr("openexr holds both"));
  EXPECT_THAT(usage("a.exr", cube(2, 2), {}), HasSubstr("holds cubes with samples at nodes"));
  EXPECT_THAT(usage("a.exr", cube(6, 3), nodes), HasSubstr("the size must halve evenly"));
  EXPECT_THAT(usage("a.exr", textured({4, 4}, 1, 1, {"R"}), nodes),
              HasSubstr("twice as wide as high"));
  EXPECT_THAT(usage("a.env", textured({4, 4}, 3, 1, {"R"}), {.type = PixelType::Rgbd8}),
              HasSubstr("found an image; env holds cubes"));
  EXPECT_THAT(usage("a.env", cube(4, 2), {.type = PixelType::Rgbd8}),
              HasSubstr("found 2 levels from 4 texels"));
  EXPECT_THAT(usage("a.env", cube(6, 3), {.type = PixelType::Rgbd8}), HasSubstr("2^n texels"));
  EXPECT_THAT(usage("a.ktx2", cube(2, 1, {"R", "G", "B", "A", "Z"}), {}),
              HasSubstr("found channels R G B A Z; ktx2 holds 1 to 4"));
  EXPECT_THAT(usage("a.ktx", cube(2, 1, {"R", "G", "B", "A"}), {.type = PixelType::E5b9g9r9}),
              HasSubstr("e5b9g9r9 holds 1 to 3"));
}

TEST_F(TextureFaults, NameMetadataThatAFormatCannotHold) {
  for (const WritableTexture& format : writable_textures()) {
    if (!format.holds_attributes) continue;
    TextureWriteOptions options = options_for(format, format.types.front(), true);
    options.attributes = {{"a", "x"}, {"a", "y"}};
    EXPECT_THAT(usage(file_of(format), cube(2, 2), options), HasSubstr("metadata name 'a'"));
  }
}

TEST_F(TextureFaults, AreInternalWhereLevelsAndFacesAreNoTexture) {
  Texture five = cube(2, 2);
  five.levels[1].pop_back();
  Texture large = cube(2, 2);
  large.levels[1] = large.levels[0];
  Texture renamed = cube(2, 1);
  renamed.levels[0][3].layers[1].name = "A";
  Texture beyond = cube(1, 1);
  beyond.levels.push_back(beyond.levels[0]);
  for (const Texture& texture :
       {Texture{}, five, large, renamed, beyond, textured({4, 2}, 1, 6, {"R"})}) {
    EXPECT_THAT(fault_text(Fault::Internal, [&] { write_texture(folder / "a.dds", texture, {}); }),
                HasSubstr("no texture"));
  }
  EXPECT_THAT(names(), IsEmpty());
}

// A bound on the size of files stands for a full disk.
TEST_F(TextureFaults, LeaveNothingWhenTheDiskIsFull) {
  write_texture(folder / "first.env", cube(1, 1), {.type = PixelType::Rgbd8});  // loads the module
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  for (const rlim_t bound : {rlim_t{0}, rlim_t{200}, rlim_t{1500}}) {
    for (const WritableTexture& format : writable_textures()) {
      const fs::path path = folder / file_of(format);
      const Texture texture = cube(64, 7);
      const rlimit small{bound, before.rlim_max};
      setrlimit(RLIMIT_FSIZE, &small);
      const std::string text = fault_text(Fault::Output, [&] {
        write_texture(path, texture, options_for(format, format.types.front(), true));
      });
      setrlimit(RLIMIT_FSIZE, &before);
      EXPECT_EQ(text, path.string() + ": cannot write: File too large") << format.name;
    }
  }
  EXPECT_EQ(names(), std::set<std::string>{"first.env"});
}

}  // namespace
}  // namespace kiln

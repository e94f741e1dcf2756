// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <sys/resource.h>

#include <algorithm>
#include <csignal>

#include "image_folder.h"

namespace kiln {
namespace {

using namespace test;
using testing::HasSubstr;
using testing::StartsWith;

class ReadFault : public ImageFolder {
 protected:
  static std::string read_fault(const fs::path& path) {
    return fault_text(Fault::Input, [&] { read_image(path); });
  }
};

TEST_F(ReadFault, SaysThatAFileIsMissing) {
  const fs::path path = folder / "none.png";
  EXPECT_EQ(read_fault(path), path.string() + ": no such file");
  EXPECT_EQ(fault_text(Fault::Input, [&] { inspect_image(path); }),
            path.string() + ": no such file");
}

TEST_F(ReadFault, SaysThatAFileIsEmpty) {
  for (const char* name : {"a.exr", "a.png", "a.hdr", "a"}) {
    const fs::path path = write_bytes(name, "");
    EXPECT_EQ(read_fault(path), path.string() + ": the file is empty (0 bytes)");
  }
}

TEST_F(ReadFault, SaysThatAPathIsAFolder) {
  EXPECT_EQ(read_fault(folder), folder.string() + ": is a folder, expected an image file");
}

TEST_F(ReadFault, SaysThatAPathIsNoFile) {
  EXPECT_EQ(read_fault("/dev/null"), "/dev/null: is not a regular file");
  EXPECT_THAT(read_fault(write_bytes("file", "x") / "a.png"), HasSubstr("a.png: "));
}

TEST_F(ReadFault, ShowsTheFirstBytesOfWhatIsNoImage) {
  const fs::path path = write_bytes("a.png", "Hello, world");
  EXPECT_THAT(read_fault(path), StartsWith(path.string() + ": not an image of a known format (it "
                                                           "begins with 48 65 6c 6c 6f"));
  EXPECT_THAT(read_fault(write_bytes("a.exr", "x")), HasSubstr("it begins with 78;"));
}

TEST_F(ReadFault, NamesTheFileOnceAndTheFormat) {
  for (const auto& [name, opening] : {std::pair<std::string, std::string>{"a.jpg", "\xff\xd8\xff"},
                                      {"a.tif", std::string("II*\0", 4)},
                                      {"a.exr", "\x76\x2f\x31\x01"},
                                      {"a.gif", "GIF8"},
                                      {"a.bmp", "BM"},
                                      {"a.psd", "8BPS"},
                                      {"a.dds", "DDS "},
                                      {"a.webp", std::string("RIFF\0\0\0\0WEBP", 12)},
                                      {"a.dpx", "SDPX"},
                                      {"a.tga", "x"},
                                      {"a.ppm", "P6"}}) {
    const fs::path path = write_bytes(name, opening + "garbage that no decoder likes at all");
    EXPECT_THAT(read_fault(path), StartsWith(path.string() + ": ")) << name;
  }
}

TEST_F(ReadFault, RefusesMoreTexelsThanTheLimitsAllow) {
  for (const WritableFormat& format : picture_formats()) {
    const fs::path path = folder / named("a", format);
    write_image(path, pattern({20, 10}, {"R", "G", "B"}), {.type = format.types.front()});
    EXPECT_THAT(fault_text(Fault::Input, [&] { read_image(path, {.max_texels = 199}); }),
                HasSubstr("the header claims 20 x 10 texels; more than 199 are not read"));
    EXPECT_EQ(read_image(path, {.max_texels = 200}).image.size, (Size{20, 10}));
    EXPECT_THAT(fault_text(Fault::Input, [&] { read_image(path, {.max_channels = 2}); }),
                HasSubstr("3 channels; more than 2"));
  }
}

class WriteFault : public ImageFolder {
 protected:
  const Layers image = pattern({8, 8}, {"R", "G", "B"});
};

TEST_F(WriteFault, NamesTheExtensionsItKnows) {
  EXPECT_THAT(
      fault_text(Fault::Usage, [&] { write_image(folder / "a.bmp", image, {}); }),
      HasSubstr("unknown file extension '.bmp' (known: .exr, .hdr, .png, .jpg, .jpeg, .tif"));
  EXPECT_THAT(fault_text(Fault::Usage, [&] { write_image(folder / "a", image, {}); }),
              HasSubstr("unknown file extension ''"));
  EXPECT_TRUE(names().empty());
}

TEST_F(WriteFault, TakesExtensionsInAnyCase) {
  write_image(folder / "a.PNG", image, {.type = PixelType::Uint8});
  EXPECT_EQ(read_image(folder / "a.PNG").facts.format, "png");
}

TEST_F(WriteFault, NamesTheTypesThatAFormatHolds) {
  EXPECT_THAT(fault_text(Fault::Usage,
                         [&] { write_image(folder / "a.png", image, {.type = PixelType::Half}); }),
              HasSubstr("a.png: png cannot hold half; it holds uint8, rgbd8, uint16"));
  for (const WritableFormat& format : writable_formats()) {
    for (const PixelType type : {PixelType::Uint8, PixelType::Uint16, PixelType::Half,
                                 PixelType::Float, PixelType::Rgb10a2, PixelType::Rgbd8}) {
      const fs::path path = folder / named("a", format);
      const bool held =
          std::find(format.types.begin(), format.types.end(), type) != format.types.end();
      if (held) {
        write_image(path, image, {.type = type});
      } else {
        fault_text(Fault::Usage, [&] { write_image(path, image, {.type = type}); });
      }
    }
  }
}

TEST_F(WriteFault, RefusesAlphaWhereAFormatHasNone) {
  const Layers alpha = pattern({8, 8}, {"R", "G", "B", "A"});
  for (const auto& [name, type] :
       {std::pair{"a.jpg", PixelType::Uint8}, std::pair{"a.hdr", PixelType::Float}}) {
    EXPECT_THAT(
        fault_text(Fault::Usage, [&] { write_image(folder / name, alpha, {.type = type}); }),
        HasSubstr("found channels R G B A"));
  }
}

TEST_F(WriteFault, RefusesFiveChannelsInPng) {
  EXPECT_THAT(fault_text(Fault::Usage,
                         [&] {
                           write_image(folder / "a.png", pattern({2, 2}, {"R", "G", "B", "A", "Z"}),
                                       {.type = PixelType::Uint8});
                         }),
              HasSubstr("png holds 1 to 4 channels"));
}

TEST_F(WriteFault, RefusesAnEmptyImage) {
  fault_text(Fault::Internal, [&] { write_image(folder / "a.exr", {}, {}); });
  fault_text(Fault::Internal, [&] { write_image(folder / "a.exr", make_layers({4, 4}, {}), {}); });
}

TEST_F(WriteFault, LeavesNothingWhereNoFolderCanBe) {
  const fs::path file = write_bytes("file", "x");
  for (const WritableFormat& format : writable_formats()) {
    const fs::path path = file / "below" / named("a", format);
    EXPECT_THAT(fault_text(Fault::Output,
                           [&] { write_image(path, image, {.type = format.types.front()}); }),
                HasSubstr("Not a directory"));
  }
  EXPECT_EQ(names(), std::set<std::string>{"file"});
}

// A bound on the size of files stands for a full disk.
TEST_F(WriteFault, LeavesNothingWhenTheDiskIsFull) {
  const Layers large = pattern({300, 300}, {"R", "G", "B"});
  read_image([&] {
    write_image(folder / "first.png", image, {.type = PixelType::Uint8});
    return folder / "first.png";
  }());
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  for (const rlim_t bound : {rlim_t{0}, rlim_t{200}, rlim_t{1500}}) {
    for (const WritableFormat& format : writable_formats()) {
      const fs::path path = folder / named("a", format);
      const rlimit small{bound, before.rlim_max};
      setrlimit(RLIMIT_FSIZE, &small);
      const std::string text = fault_text(
          Fault::Output, [&] { write_image(path, large, {.type = format.types.front()}); });
      setrlimit(RLIMIT_FSIZE, &before);
      EXPECT_EQ(text, path.string() + ": cannot write: File too large") << format.name;
    }
  }
  EXPECT_EQ(names(), std::set<std::string>{"first.png"});
}

TEST_F(WriteFault, LeavesTheOldFileWhenTheNewOneFails) {
  write_image(folder / "a.exr", image, {});
  const std::string before = bytes_of(folder / "a.exr");
  fault_text(Fault::Usage, [&] {
    write_image(folder / "a.exr", image, {.attributes = {{"channels", "x"}}});
  });
  EXPECT_EQ(bytes_of(folder / "a.exr"), before);
  EXPECT_EQ(names(), std::set<std::string>{"a.exr"});
}

}  // namespace
}  // namespace kiln

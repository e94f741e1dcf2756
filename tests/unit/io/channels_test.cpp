// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "crafted_files.h"
#include "file_bytes.h"
#include "image_folder.h"

namespace kiln {
namespace {

using namespace test;
using testing::ElementsAre;

class Channels : public ImageFolder {};

void expect_plane(const Layers& found, const Layers& whole, const std::string& name) {
  ASSERT_NE(found.find(name), nullptr) << name;
  for (int y = 0; y < whole.size.height; ++y) {
    const auto a = found.find(name)->texels_of_row(y), b = whole.find(name)->texels_of_row(y);
    ASSERT_TRUE(std::equal(a.begin(), a.end(), b.begin(), b.end())) << name;
  }
}

TEST_F(Channels, ThatAreNotWantedAreNotReturned) {
  for (const char* name : {"a.exr", "a.tif", "a.png", "a.dds", "a.npy"}) {
    SCOPED_TRACE(name);
    write_image(folder / name, pattern({70, 90}, {"R", "G", "B", "A"}),
                {.type = writable_format(name).types.front()});
    const ImageFile whole = read_image(folder / name);
    const ImageFile some = read_image(folder / name, {}, {"B", "R"});
    EXPECT_EQ(some.facts.channels, whole.facts.channels);
    EXPECT_EQ(some.image.size, whole.image.size);
    if (whole.facts.channels.front() != "R") continue;
    EXPECT_THAT(channel_names(some.image), ElementsAre("R", "B"));
    expect_plane(some.image, whole.image, "R");
    expect_plane(some.image, whole.image, "B");
  }
}

TEST_F(Channels, OfHdrPicturesMayBeOne) {
  write_image(folder / "a.hdr", pattern({20, 9}, {"R", "G", "B"}), {.type = PixelType::Float});
  EXPECT_THAT(channel_names(read_image(folder / "a.hdr", {}, {"G"}).image), ElementsAre("G"));
}

TEST_F(Channels, OfColourAreDividedByAnAlphaThatIsNotWanted) {
  const fs::path path =
      write_bytes("a.tif", tiff({.samples = 4, .extra_sample = 1, .pixels = "\x64\x32\x19\x80"}));
  const ImageFile file = read_image(path, {}, {"R"});
  EXPECT_THAT(channel_names(file.image), ElementsAre("R"));
  EXPECT_NEAR(file.image.find("R")->at(0, 0), 100.0f / 128, 1e-6);
}

TEST_F(Channels, OfALargeFileComeFromItsMappedBytes) {
  const fs::path path = write_bytes("a.bin", "begin");
  constexpr size_t size = io::FileContents::largest_held + 10;
  fs::resize_file(path, size);
  std::fstream(path, std::ios::in | std::ios::out | std::ios::binary).seekp(size - 3) << "end";
  const io::FileContents contents(path);
  const auto text = [&](size_t at, size_t count) {
    return std::string(reinterpret_cast<const char*>(contents.view().data()) + at, count);
  };
  ASSERT_EQ(contents.view().size(), size);
  EXPECT_EQ(text(0, 5), "begin");
  EXPECT_EQ(text(size - 3, 3), "end");
  contents.let_go();
  EXPECT_EQ(text(0, 5), "begin") << "it comes back";
}

}  // namespace
}  // namespace kiln

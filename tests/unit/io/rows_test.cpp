// SPDX-License-Identifier: Apache-2.0
// Images that are read some rows at a time.
#include <gmock/gmock.h>

#include <algorithm>

#include "image_folder.h"
#include "kiln/io/image_rows.h"
#include "texture_pattern.h"

namespace kiln {
namespace {

using namespace test;

class Rows : public ImageFolder {
 protected:
  // Every value, read in steps of so many rows, against the image read whole.
  static void expect_same_values(const fs::path& path, int step) {
    SCOPED_TRACE(path.filename().string() + " in steps of " + std::to_string(step));
    const ImageFile whole = read_image(path);
    ImageRows rows(path);
    ASSERT_EQ(rows.facts().size, whole.facts.size);
    EXPECT_EQ(rows.facts().channels, whole.facts.channels);
    const int height = whole.image.size.height;
    for (int first = 0; first < height; first += step) {
      const Layers band = rows.next(std::min(step, height - first));
      ASSERT_EQ(band.layers.size(), whole.image.layers.size());
      for (size_t c = 0; c < band.layers.size(); ++c) {
        EXPECT_EQ(band.layers[c].name, whole.image.layers[c].name);
        for (int y = 0; y < band.size.height; ++y) {
          const auto is = band.layers[c].plane.texels_of_row(y);
          const auto expected = whole.image.layers[c].plane.texels_of_row(first + y);
          ASSERT_TRUE(std::equal(is.begin(), is.end(), expected.begin())) << first + y;
        }
      }
    }
  }
};

TEST_F(Rows, AreThoseOfTheWholeImageInEveryFormatAndType) {
  const Layers image = pattern({37, 203}, {"R", "G", "B"});
  for (const WritableFormat& format : picture_formats()) {
    for (const PixelType type : format.types) {
      const fs::path path = folder / named("x", format);
      write_image(path, image, {.type = type});
      for (const int step : {1, 50, 64, 203}) expect_same_values(path, step);
    }
  }
}

TEST_F(Rows, HoldOnlyTheChannelsThatAreWanted) {
  for (const char* name : {"x.exr", "x.png", "x.tif"}) {
    write_image(
        folder / name, pattern({9, 70}, {"R", "G", "B", "A"}),
        {.type = PixelType::Uint8 == writable_format(name).types.front() ? PixelType::Uint8
                                                                         : PixelType::Half});
    ImageRows rows(folder / name, {"G", "A"});
    const Layers band = rows.next(70);
    ASSERT_EQ(band.layers.size(), 2u) << name;
    EXPECT_EQ(band.layers[0].name, "G");
    EXPECT_EQ(band.layers[1].name, "A");
    const ImageFile whole = read_image(folder / name);
    EXPECT_EQ(band.layers[0].plane.at(3, 66), whole.image.find("G")->at(3, 66));
  }
}

TEST_F(Rows, TellWhereADamagedFileEnds) {
  write_image(folder / "x.png", pattern({64, 300}, {"R", "G", "B"}), {.type = PixelType::Uint8});
  const std::string bytes = bytes_of(folder / "x.png");
  write_bytes("cut.png", bytes.substr(0, bytes.size() / 2));
  fault_text(Fault::Input, [&] { ImageRows(folder / "cut.png").next(300); });
  fault_text(Fault::Input, [&] { ImageRows rows(folder / "absent.png"); });
}

}  // namespace
}  // namespace kiln

// SPDX-License-Identifier: Apache-2.0
// Images that are written a band at a time.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "image_folder.h"

namespace kiln {
namespace {

using namespace test;
using testing::HasSubstr;

Layers rows_of(const Layers& image, int first, int rows) {
  Layers band{{image.size.width, rows}, {}};
  for (const Layer& layer : image.layers) {
    Plane& plane = band.add(layer.name);
    for (int y = 0; y < rows; ++y) {
      std::copy_n(layer.plane.row(first + y), image.size.width, plane.row(y));
    }
  }
  return band;
}

ImageBands bands_of(const Layers& image, int band_rows) {
  return {image.size, channel_names(image), band_rows,
          [&image](int first, int rows) { return rows_of(image, first, rows); }};
}

class Bands : public ImageFolder {
 protected:
  // The bytes of the image written whole and in bands of several heights.
  void expect_same_bytes(const Layers& image, const WritableFormat& format,
                         const WriteOptions& options) const {
    const fs::path whole = folder / "whole" / named("x", format);
    const fs::path banded = folder / "banded" / named("x", format);
    const WriteFacts facts = write_image(whole, image, options);
    for (const int rows : {1, 7, 32, image.size.height}) {
      SCOPED_TRACE(whole.filename().string() + " " + std::string(pixel_type_name(options.type)) +
                   " x" + std::to_string(image.layers.size()) + " in bands of " +
                   std::to_string(rows));
      const WriteFacts found = write_bands(banded, bands_of(image, rows), options);
      EXPECT_TRUE(bytes_of(whole) == bytes_of(banded));
      EXPECT_EQ(found.clamped, facts.clamped);
      EXPECT_EQ(found.not_a_number, facts.not_a_number);
      EXPECT_EQ(found.largest_clamped, facts.largest_clamped);
    }
  }
};

// Values that some types clamp, and one that integers do not hold.
Layers odd_pattern(const std::vector<std::string>& names) {
  Layers image = pattern({11, 135}, names);
  Plane& plane = image.layers.front().plane;
  plane.at(3, 2) = 1.5f;
  plane.at(4, 100) = 90000.0f;
  plane.at(5, 130) = std::nanf("");
  return image;
}

TEST_F(Bands, MakeTheBytesOfTheWholeImageInEveryFormatAndType) {
  for (const WritableFormat& format : writable_formats()) {
    const bool has_alpha = format.name != "hdr" && format.name != "jpeg";
    for (const auto& names : {std::vector<std::string>{"E"}, {"R", "G"}, {"A", "B", "G", "R"}}) {
      if (names.size() == 4 && !has_alpha) continue;
      for (const PixelType type : format.types) {
        if (type == PixelType::Rgbd8 && names.size() == 4) continue;
        expect_same_bytes(odd_pattern(names), format, {.type = type});
      }
    }
  }
}

TEST_F(Bands, MakeTheBytesOfVolumesAndTheirLabels) {
  WriteOptions options;
  options.depth = 3;
  options.attributes = {{"kiln:table", "glass"}, {"Software", "kiln"}};
  options.labels.channels = {"reflected", "transmitted"};
  options.labels.axes = {{"mu", {}}, {"roughness", {}}, {"ior", {1, 1.5, 2}}};
  for (int i = 0; i < 11; ++i) options.labels.axes[0].coordinates.push_back(0.1 * i);
  for (int i = 0; i < 45; ++i) options.labels.axes[1].coordinates.push_back(0.02 * i);
  for (const WritableFormat& format : table_formats()) {
    options.type = format.types.back();
    expect_same_bytes(odd_pattern({"R", "G"}), format, options);
  }
}

TEST_F(Bands, MakeTheBytesOfPremultipliedPackedPictures) {
  const WritableFormat& exr = writable_format("x.exr");
  for (const Packing packing : {Packing::Zip, Packing::Fast}) {
    expect_same_bytes(
        odd_pattern({"R", "G", "B", "A", "stderr.R"}), exr,
        {.type = PixelType::Half, .alpha = AlphaStorage::Premultiplied, .packing = packing});
  }
}

TEST_F(Bands, AreAskedForFromTheTopOnceEachAndLetGoBeforeTheNext) {
  for (const WritableFormat& format : writable_formats()) {
    std::vector<std::pair<int, int>> asked;
    const ImageBands image{{4, 10}, {"R", "G", "B"}, 4, [&](int first, int rows) {
                             asked.emplace_back(first, rows);
                             return pattern({4, rows}, {"R", "G", "B"});
                           }};
    write_bands(folder / named("x", format), image, {.type = format.types.front()});
    EXPECT_EQ(asked, (std::vector<std::pair<int, int>>{{0, 4}, {4, 4}, {8, 2}})) << format.name;
  }
}

TEST_F(Bands, LeaveTheOldFileWhereOneCannotBeMade) {
  for (const WritableFormat& format : writable_formats()) {
    const fs::path path = folder / named("x", format);
    const WriteOptions options{.type = format.types.front()};
    write_image(path, pattern({4, 200}, {"R", "G", "B"}), options);
    const std::string before = bytes_of(path);
    const ImageBands image{{4, 200}, {"R", "G", "B"}, 80, [](int first, int rows) {
                             if (first > 80) throw std::runtime_error("stop");
                             return pattern({4, rows}, {"R", "G", "B"});
                           }};
    EXPECT_THROW(write_bands(path, image, options), std::runtime_error) << format.name;
    EXPECT_EQ(bytes_of(path), before) << format.name;
  }
  EXPECT_EQ(names().size(), writable_formats().size());
}

TEST_F(Bands, AreRefusedWhereTheyAreNotAsPromised) {
  const auto refuses = [&](Size band, const std::vector<std::string>& names) {
    const ImageBands image{
        {4, 10}, {"R", "G", "B"}, 5, [&](int, int) { return pattern(band, names); }};
    fault_text(Fault::Internal, [&] { write_bands(folder / "a.exr", image, {}); });
  };
  refuses({4, 4}, {"R", "G", "B"});
  refuses({3, 5}, {"R", "G", "B"});
  refuses({4, 5}, {"R", "G"});
  refuses({4, 5}, {"R", "G", "X"});
  fault_text(Fault::Internal, [&] { write_bands(folder / "a.exr", {{4, 10}, {}, 5, {}}, {}); });
  fault_text(Fault::Internal, [&] { write_bands(folder / "a.exr", {{4, 10}, {"Y"}, 0, {}}, {}); });
  EXPECT_TRUE(names().empty());
}

TEST_F(Bands, AreRefusedBeforeTheFirstWhereTheFormatCannotHoldThem) {
  const ImageBands image{{4, 10}, {"R", "G", "B", "A"}, 5, [](int, int) -> Layers {
                           throw std::logic_error("asked for");
                         }};
  EXPECT_THAT(fault_text(Fault::Usage,
                         [&] { write_bands(folder / "a.hdr", image, {.type = PixelType::Float}); }),
              HasSubstr("found channels R G B A"));
}

}  // namespace
}  // namespace kiln

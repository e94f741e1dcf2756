// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <chrono>
#include <cmath>
#include <iterator>
#include <thread>

#include "image_folder.h"
#include "kiln/io/number_arrays.h"

namespace kiln {
namespace {

using namespace test;
using testing::ElementsAre;

const std::vector<std::vector<std::string>> color_names{
    {"Y"}, {"Y", "A"}, {"R", "G", "B"}, {"R", "G", "B", "A"}};

std::ptrdiff_t thread_count() {
  const auto tasks = fs::directory_iterator("/proc/self/task");
  return std::distance(begin(tasks), end(tasks));
}

// Before any test, so before a decoder was loaded.
const std::ptrdiff_t threads_at_start = thread_count();

bool holds(const WritableFormat& format, const std::vector<std::string>& names) {
  const bool alpha = names.back() == "A";
  return !alpha || (format.name != "hdr" && format.name != "jpeg");
}

// Half a step of what a type stores in [0,1], and what a format adds to it.
double tolerance(const WritableFormat& format, PixelType type) {
  if (format.name == "hdr") return 0.5 / 128;
  if (format.name == "jpeg") return 1;  // the pattern is noise to it; see the tests of JPEG
  switch (type) {
    case PixelType::Uint8:
      return 0.5001 / 255;
    case PixelType::Uint16:
      return 0.5001 / 65535;
    case PixelType::Half:
      return 0.0003;
    default:
      return 0;
  }
  return 0;
}

class RoundTrip : public ImageFolder {};

TEST_F(RoundTrip, KeepsValuesAndNamesInEveryFormatTypeAndNumberOfChannels) {
  for (const WritableFormat& format : picture_formats()) {
    for (const PixelType type : format.types) {
      if (type == PixelType::Rgbd8) continue;  // see the tests of tables
      for (const auto& names : color_names) {
        if (!holds(format, names)) continue;
        const std::string file = named("x", format);
        SCOPED_TRACE(file + " " + std::string(pixel_type_name(type)) + " " + names.front() + "x" +
                     std::to_string(names.size()));
        const Layers image = pattern({33, 70}, names);
        const WriteFacts facts = write_image(folder / file, image, {.type = type});
        EXPECT_EQ(facts.clamped, 0);
        const ImageFile read = read_image(folder / file);
        EXPECT_EQ(read.facts.format, format.name);
        EXPECT_EQ(read.facts.type, type);
        EXPECT_EQ(read.image.size, image.size);
        const bool repeated = format.name == "hdr" && names.size() == 1;
        if (!repeated) {
          EXPECT_EQ(channel_names(read.image), names);
        }
        EXPECT_EQ(read.facts.channels, channel_names(read.image));
        for (size_t c = 0; c < names.size(); ++c) {
          double worst = 0;
          for (int y = 0; y < 70; ++y) {
            for (int x = 0; x < 33; ++x) {
              worst = std::max(worst, std::abs(double(read.image.layers[c].plane.at(x, y)) -
                                               image.layers[c].plane.at(x, y)));
            }
          }
          EXPECT_LE(worst, tolerance(format, type));
        }
      }
    }
  }
}

TEST_F(RoundTrip, WritesTheSameBytesTwiceInEveryFormatAndType) {
  for (const WritableFormat& format : writable_formats()) {
    for (const PixelType type : format.types) {
      const Layers image = pattern({65, 33}, {"R", "G", "B"});
      const WriteOptions options{.type = type, .attributes = {{"model", "ggx"}}};
      const fs::path first = folder / named("a", format),
                     second = folder / "b" / named("a", format);
      write_image(first, image, options);
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
      write_image(second, image, options);
      EXPECT_EQ(bytes_of(first), bytes_of(second)) << format.name << " " << pixel_type_name(type);
    }
  }
}

TEST_F(RoundTrip, CarriesNoDateAndNoClock) {
  for (const WritableFormat& format : writable_formats()) {
    const std::string file = named("a", format);
    write_image(folder / file, pattern({8, 8}, {"R", "G", "B"}), {.type = format.types.front()});
    const std::string bytes = bytes_of(folder / file);
    for (const char* sign : {"capDate", "tIME", "2026"}) {
      EXPECT_EQ(bytes.find(sign), std::string::npos) << file << " holds " << sign;
    }
  }
}

TEST_F(RoundTrip, KeepsTextMetadataWhereTheFormatHoldsIt) {
  const Attributes attributes{{"ImageDescription", "table of E, mu x roughness"},
                              {"kiln:axes", "mu, roughness"},
                              {"max_error", "1e-07"}};
  for (const WritableFormat& format : writable_formats()) {
    const fs::path path = folder / named("a", format);
    write_image(path, pattern({8, 8}, {"R", "G", "B"}),
                {.type = format.types.back(), .attributes = attributes});
    const Attributes found = read_arrays(path).front().attributes;
    for (const auto& attribute : attributes) {
      if (format.holds_attributes) {
        EXPECT_THAT(found, testing::Contains(attribute)) << format.name;
      } else {
        EXPECT_THAT(found, testing::Not(testing::Contains(attribute))) << format.name;
      }
    }
  }
}

TEST_F(RoundTrip, InspectsWhatReadingReturns) {
  for (const WritableFormat& format : picture_formats()) {
    const std::string file = named("a", format);
    write_image(folder / file, pattern({19, 5}, {"R", "G", "B"}), {.type = format.types.front()});
    const FileFacts header = inspect_image(folder / file);
    const FileFacts whole = read_image(folder / file).facts;
    EXPECT_EQ(header.format, whole.format);
    EXPECT_EQ(header.size, (Size{19, 5}));
    EXPECT_EQ(header.size, whole.size);
    EXPECT_EQ(header.channels, whole.channels);
    EXPECT_EQ(header.type, whole.type);
    EXPECT_EQ(header.notes, whole.notes);
  }
}

TEST_F(RoundTrip, PutsColourInTheOrderOfTheFile) {
  const Layers shuffled = pattern({4, 4}, {"A", "B", "R", "G"});
  write_image(folder / "a.png", shuffled, {.type = PixelType::Uint8});
  const ImageFile read = read_image(folder / "a.png");
  EXPECT_THAT(channel_names(read.image), ElementsAre("R", "G", "B", "A"));
  for (const Layer& layer : shuffled.layers) {
    EXPECT_NEAR(read.image.find(layer.name)->at(2, 3), layer.plane.at(2, 3), 1e-6) << layer.name;
  }
}

TEST_F(RoundTrip, GivesTwoChannelsWithoutAlphaAThirdOfZeros) {
  const Layers table = pattern({16, 16}, {"R", "G"});
  for (const auto& [file, type] :
       {std::pair{"a.png", PixelType::Uint16}, std::pair{"a.hdr", PixelType::Float}}) {
    write_image(folder / file, table, {.type = type});
    const ImageFile read = read_image(folder / file);
    EXPECT_THAT(channel_names(read.image), ElementsAre("R", "G", "B")) << file;
    EXPECT_NEAR(read.image.find("G")->at(3, 2), table.layers[1].plane.at(3, 2), 0.004) << file;
    EXPECT_EQ(read.image.find("B")->at(3, 2), 0) << file;
  }
}

TEST_F(RoundTrip, ClampsFiniteValuesBeyondTheRangeAndCountsThem) {
  Layers image = make_layers({4, 1}, {"Y"});
  const float values[] = {70000.0f, -70000.0f, 65504.0f, INFINITY};
  for (int x = 0; x < 4; ++x) image.layers[0].plane.at(x, 0) = values[x];
  const WriteFacts half = write_image(folder / "a.exr", image, {.type = PixelType::Half});
  EXPECT_EQ(half.clamped, 2);
  EXPECT_EQ(half.largest_clamped, 70000);
  const ImageFile read = read_image(folder / "a.exr");
  EXPECT_THAT(read.image.layers[0].plane.texels_of_row(0),
              ElementsAre(65504.0f, -65504.0f, 65504.0f, INFINITY));
  EXPECT_EQ(write_image(folder / "b.exr", image, {.type = PixelType::Float}).clamped, 0);
  EXPECT_EQ(read_image(folder / "b.exr").image.layers[0].plane.at(0, 0), 70000.0f);
}

TEST_F(RoundTrip, ClampsIntegersToTheirRangeAndTurnsNanToZero) {
  Layers image = make_layers({5, 1}, {"Y"});
  const float values[] = {-0.5f, 1.5f, NAN, INFINITY, 0.5f};
  for (int x = 0; x < 5; ++x) image.layers[0].plane.at(x, 0) = values[x];
  const WriteFacts facts = write_image(folder / "a.png", image, {.type = PixelType::Uint16});
  EXPECT_EQ(facts.clamped, 2);
  EXPECT_EQ(facts.not_a_number, 1);
  EXPECT_THAT(read_image(folder / "a.png").image.layers[0].plane.texels_of_row(0),
              ElementsAre(0.0f, 1.0f, 0.0f, 1.0f, 32768.0f / 65535.0f));
}

TEST_F(RoundTrip, WorksFromManyThreadsAtOnce) {
  std::vector<std::jthread> threads;
  for (int t = 0; t < 4; ++t) {
    threads.emplace_back([&, t] {
      for (const WritableFormat& format : picture_formats()) {
        const fs::path path = folder / named(std::to_string(t), format);
        write_image(path, pattern({40, 40}, {"R", "G", "B"}), {.type = format.types.front()});
        EXPECT_EQ(read_image(path).image.size, (Size{40, 40}));
      }
    });
  }
}

TEST_F(RoundTrip, LeavesNoThreadsBehind) {
  write_image(folder / "a.png", pattern({4, 4}, {"Y"}), {.type = PixelType::Uint8});
  read_image(folder / "a.png");
  EXPECT_EQ(thread_count(), threads_at_start);
}

}  // namespace
}  // namespace kiln

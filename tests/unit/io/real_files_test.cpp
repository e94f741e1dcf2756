// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <unistd.h>

#include <algorithm>

#include "image_folder.h"
#include "support/real_data.h"

namespace kiln {
namespace {

using namespace test;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

std::vector<fs::path> files_below(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

bool is_image(const fs::path& path) {
  const std::string extension = path.extension().string();
  return extension == ".exr" || extension == ".hdr" || extension == ".png" || extension == ".jpg";
}

double mean(const Plane& plane) {
  double sum = 0;
  for (int y = 0; y < plane.height(); ++y) {
    for (const float v : plane.texels_of_row(y)) sum += v;
  }
  return sum / static_cast<double>(area(plane.size()));
}

TEST(DamagedFiles, AreRefusedOrReadAndNeverCrash) {
  KILN_REQUIRE_REAL_DATA(data);
  for (const fs::path& path : files_below(data / "data/damaged")) {
    std::string outcome = "read";
    try {
      const ImageFile file = read_image(path);
      EXPECT_GT(area(file.image.size), 0) << path;
      EXPECT_EQ(file.image.layers.size(), file.facts.channels.size()) << path;
    } catch (const Error& error) {
      outcome = error.what();
      EXPECT_EQ(error.fault(), Fault::Input) << outcome;
      EXPECT_THAT(outcome, testing::StartsWith(path.string() + ": "));
    }
    RecordProperty(path.filename().string(), outcome);
  }
}

TEST(DamagedFiles, OfTheseAreRefusedWithTheirReason) {
  KILN_REQUIRE_REAL_DATA(data);
  const std::pair<const char*, const char*> expected[] = {
      {"derived/venice_truncated_60pct.hdr", "truncated"},
      {"oiio/hdr_bomb-40000.hdr", "40000 x 40000 texels; more than"},
      {"oiio/png-bomb_bomb.png", "46340 x 46340 texels; more than"},
      {"oiio/openexr-bomb_bomb.exr", ""},
      {"openexr_tests/invalid.exr", ""},
      {"openexr_tests/comp_early_eof_piz.exr", ""},
      {"openexr_tests/comp_invalid_unknown.exr", ""}};
  for (const auto& [name, reason] : expected) {
    const fs::path path = data / "data/damaged" / name;
    EXPECT_THAT(fault_text(Fault::Input, [&] { read_image(path); }), HasSubstr(reason)) << name;
  }
}

TEST(DamagedFiles, OfTheseTheImageIsWhole) {
  KILN_REQUIRE_REAL_DATA(data);
  EXPECT_GT(area(read_image(data / "data/damaged/oiio/jpeg-corrupt_corrupt-exif.jpg").image.size),
            0);
}

TEST(RealFiles, AllReadAndAgreeWithTheirHeaders) {
  KILN_REQUIRE_REAL_DATA(data);
  for (const char* below : {"data/env", "data/materials", "data/reference"}) {
    for (const fs::path& path : files_below(data / below)) {
      if (!is_image(path)) continue;
      SCOPED_TRACE(path);
      const FileFacts header = inspect_image(path);
      const ImageFile file = read_image(path);
      EXPECT_EQ(header.size, file.image.size);
      EXPECT_EQ(header.channels, channel_names(file.image));
    }
  }
}

TEST(RealFiles, EveryHalfValueComesThrough) {
  KILN_REQUIRE_REAL_DATA(data);
  const ImageFile file = read_image(data / "data/env/AllHalfValues.exr");
  EXPECT_EQ(file.image.size, (Size{256, 256}));
  EXPECT_EQ(file.facts.type, PixelType::Half);
  const Oddities odd = count_oddities(file.image);
  // Of 65536 half values 2046 are NaN and 2 infinite; the image holds each once in every channel.
  EXPECT_EQ(odd.nan, 3 * 2046);
  EXPECT_EQ(odd.inf, 3 * 2);
}

TEST(RealFiles, NanAndInfComeThrough) {
  KILN_REQUIRE_REAL_DATA(data);
  const ImageFile file = read_image(data / "data/env/BrightRingsNanInf.exr");
  EXPECT_EQ(file.image.size, (Size{800, 800}));
  const Oddities odd = count_oddities(file.image);
  EXPECT_GT(odd.nan, 0);
  EXPECT_GT(odd.inf, 0);
}

TEST(RealFiles, ALatLongWithSamplesOnItsBorderIsNodeAligned) {
  KILN_REQUIRE_REAL_DATA(data);
  const ImageFile file = read_image(data / "data/env/OrientationLatLong.exr");
  EXPECT_TRUE(file.facts.node_aligned);
  EXPECT_EQ(file.facts.envmap, Envmap::LatLong);
  EXPECT_EQ(file.image.size, (Size{1024, 512}));
  EXPECT_THAT(channel_names(file.image), ElementsAre("R", "G", "B", "A"));
  for (const char* name : {"R", "G", "B"}) {
    const Plane& plane = *file.image.find(name);
    for (int y = 0; y < 512; ++y) ASSERT_NEAR(plane.at(0, y), plane.at(1023, y), 2e-3);
  }
  const FileFacts cube = inspect_image(data / "data/env/OrientationCube.exr");
  EXPECT_TRUE(cube.node_aligned);
  EXPECT_EQ(cube.envmap, Envmap::Cube);
  EXPECT_THAT(cube.notes, Contains(HasSubstr("cube environment")));
}

TEST(RealFiles, MeanRadianceOfHdrPicturesIsTheExpectedOne) {
  KILN_REQUIRE_REAL_DATA(data);
  const ImageFile venice = read_image(data / "data/env/venice_sunset_1k.hdr");
  EXPECT_EQ(venice.facts.format, "hdr");
  EXPECT_EQ(venice.image.size, (Size{1024, 512}));
  EXPECT_THAT(venice.image.find("R")->texels_of_row(256), testing::Each(testing::Gt(0.0f)));
  EXPECT_GT(mean(*venice.image.find("R")), 0.1);
}

TEST(RealFiles, WritingAndReadingPngKeepsEveryTexel) {
  KILN_REQUIRE_REAL_DATA(data);
  const fs::path folder =
      fs::path(testing::TempDir()) / ("kiln_real_" + std::to_string(::getpid()));
  for (const char* name : {"panel_gltf_mr_and_specgloss_1k/sg_specularGlossiness.png",
                           "fabric_Fabric02_2048x2463_nonormal/DERIVED_height16_1024.png"}) {
    const ImageFile before = read_image(data / "data/materials" / name);
    write_image(folder / "a.png", before.image, {.type = before.facts.type});
    const ImageFile after = read_image(folder / "a.png");
    ASSERT_EQ(after.facts.channels, before.facts.channels);
    for (size_t c = 0; c < before.image.layers.size(); ++c) {
      for (int y = 0; y < before.image.size.height; ++y) {
        ASSERT_TRUE(std::ranges::equal(before.image.layers[c].plane.texels_of_row(y),
                                       after.image.layers[c].plane.texels_of_row(y)))
            << name;
      }
    }
  }
  fs::remove_all(folder);
}

}  // namespace
}  // namespace kiln

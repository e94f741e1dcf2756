// SPDX-License-Identifier: Apache-2.0
// The demo, small: every task succeeds, and the pictures are those that were looked at.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "kiln/image/compare.h"
#include "kiln/io/image_file.h"
#include "support/command.h"
#include "support/places.h"

namespace kiln {
namespace {

const std::filesystem::path source = test::source_folder();
const std::string demo = (source / "pipelines/demo.yaml").string();
const std::vector<std::string> sets = {"brushed_steel", "glazed_tiles", "rusted_iron",
                                       "woven_fabric", "painted_panel"};

std::vector<std::string> small_demo(const std::filesystem::path& out) {
  return {"run", demo, "-o", out.string(), "--set", "size=48", "--set", "samples=64"};
}

std::vector<std::filesystem::path> files_below(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

TEST(DemoPipeline, BakesEveryTaskTheSameForAnyNumberOfThreads) {
  const test::Workshop shop;
  auto one = small_demo(shop / "one"), many = small_demo(shop / "many");
  one.insert(one.end(), {"-j", "1"});
  many.insert(many.end(), {"-j", "3"});
  const test::Outcome first = test::kiln(shop, one), second = test::kiln(shop, many);
  EXPECT_EQ(first.code, 0) << first.err;
  EXPECT_EQ(second.code, 0) << second.err;
  int compared = 0;
  for (const auto& file : files_below(shop / "one")) {
    if (file.filename() == "times.json") continue;
    const auto other = shop / "many" / std::filesystem::relative(file, shop / "one");
    EXPECT_EQ(test::text_of(file), test::text_of(other)) << file.filename();
    ++compared;
  }
  EXPECT_GT(compared, 80);
}

// Radiance may differ between processors in the last bits, and where a sample falls on the other
// side of an edge by its noise: pictures are held to a tenth of their stated error.
TEST(DemoPipeline, LooksAsItDidWhenItWasLookedAt) {
  const test::Workshop shop;
  const test::Outcome run =
      test::kiln(shop, {"run", demo, "-o", (shop / "out").string(), "--set", "size=48", "--set",
                        "samples=256", "--only", "*/sphere.exr"});
  ASSERT_EQ(run.code, 0) << run.err;
  for (const std::string& set : sets) {
    const auto expected = source / "tests/golden/expected" / (set + ".exr");
    const Difference difference =
        compare(read_image(shop / "out" / set / "sphere.exr").image, read_image(expected).image);
    EXPECT_LE(difference.mean, 2e-4) << set;
    EXPECT_LE(difference.percentile_95, 1e-3) << set;
  }
}

TEST(FolderPipeline, BakesTheShippedSetsAndSkipsFoldersWithoutMaps) {
  const test::Workshop shop;
  const test::Outcome run =
      test::kiln(shop, {"run", (source / "pipelines/folder.yaml").string(), "-o",
                        (shop / "out").string(), "--set", "size=32", "--set", "samples=16"});
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_NE(run.err.find("generator"), std::string::npos) << "names the folder it skips";
  for (const std::string& set : sets) {
    EXPECT_TRUE(std::filesystem::exists(shop / "out" / set / "sphere.png")) << set;
  }
}

}  // namespace
}  // namespace kiln

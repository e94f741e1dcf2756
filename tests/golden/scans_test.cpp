// SPDX-License-Identifier: Apache-2.0
// Real scans, as their authors named and packed them. Skipped where they are not at hand.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "kiln/image/compare.h"
#include "kiln/io/image_file.h"
#include "support/command.h"
#include "support/places.h"
#include "support/real_data.h"

namespace kiln {
namespace {

using Json = nlohmann::json;

const std::string folder_pipeline = (test::source_folder() / "pipelines/folder.yaml").string();

struct Baked {
  test::Outcome run;
  Json report;
};

Baked bake_scans(const test::Workshop& shop, const std::filesystem::path& materials,
                 const std::filesystem::path& environment) {
  const test::Outcome run =
      test::kiln(shop, {"run", folder_pipeline, "-o", (shop / "out").string(), "--set",
                        "textures=" + materials.string(), "--set", "studio=" + environment.string(),
                        "--set", "size=256", "--set", "samples=16"});
  return {run, Json::parse(test::text_of(shop / "out/.kiln/report.json"))};
}

Layers colors_of(const std::filesystem::path& path) {
  Layers image = read_image(path).image;
  std::erase_if(image.layers, [](const Layer& l) { return l.name.size() > 1 || l.name == "A"; });
  return image;
}

double mean_of(const Layers& image, const std::string& channel) {
  double sum = 0;
  const Plane& plane = *image.find(channel);
  for (int y = 0; y < plane.height(); ++y) {
    for (const float value : plane.texels_of_row(y)) sum += value;
  }
  return sum / static_cast<double>(area(plane.size()));
}

TEST(Scans, BakeFromTheFoldersAsTheyAre) {
  KILN_REQUIRE_REAL_DATA(folder);
  const test::Workshop shop;
  const auto [run, report] =
      bake_scans(shop, folder / "data/materials", folder / "data/env/studio_small_03_1k.hdr");
  ASSERT_EQ(run.code, 0) << run.err;

  const std::string panel = "panel_gltf_mr_and_specgloss_1k";
  const std::vector<std::string> sets = {
      "rusty_metal_Metal053C_1k_gl", "rock_Rock020_1k_dx",
      "copper_tiles_01_2k",          "fabric_Fabric02_2048x2463_nonormal",
      "boombox_gltf_orm_2k",         panel + ".metal_rough",
      panel + ".spec_gloss"};
  for (const std::string& set : sets) {
    for (const char* picture :
         {"flat_split_sum.exr", "flat_split_sum.png", "flat.png", "sphere.png"}) {
      EXPECT_TRUE(std::filesystem::exists(shop / "out" / set / picture)) << set << " " << picture;
    }
  }
  EXPECT_FALSE(std::filesystem::exists(shop / "out/udim_grid_512")) << "has no known map";
  EXPECT_NE(run.err.find("udim_grid_512"), std::string::npos) << "and that is said";
  EXPECT_NE(run.err.find("DirectX"), std::string::npos) << "the rock's normals are recognised";

  const Difference panels =
      compare(colors_of(shop / "out" / (panel + ".metal_rough") / "flat_split_sum.exr"),
              colors_of(shop / "out" / (panel + ".spec_gloss") / "flat_split_sum.exr"));
  EXPECT_LE(panels.mean, 0.005);
  EXPECT_LE(panels.percentile_95, 0.02);

  const Layers rust = colors_of(shop / "out/rusty_metal_Metal053C_1k_gl/flat_split_sum.exr");
  EXPECT_GT(mean_of(rust, "R"), 1.1 * mean_of(rust, "B")) << "rust is redder than it is blue";
}

TEST(Scans, EnvironmentsOfEveryKindBecomeAChain) {
  KILN_REQUIRE_REAL_DATA(folder);
  for (const char* name : {"venice_sunset_1k.hdr", "studio_small_03_1k.hdr",
                           "apartment_512_dwab.exr", "OrientationLatLong.exr"}) {
    const test::Workshop shop;
    const test::Outcome run = test::kiln(shop, {"env", (folder / "data/env" / name).string(), "-o",
                                                (shop / "out").string(), "--size", "64"});
    ASSERT_EQ(run.code, 0) << name << ": " << run.err;
    const Json env = Json::parse(test::text_of(shop / "out/env.json"));
    for (const double error : env["error"]["levels"]) EXPECT_LT(error, 1e-3) << name;
    EXPECT_TRUE(std::filesystem::exists(shop / "out/specular_m2_nz.exr")) << name;
  }
}

TEST(Scans, LightTheSideThatFacesTheSun) {
  // The sunset's sun stands toward -X and +Z: a ball is brighter on its left.
  KILN_REQUIRE_REAL_DATA(folder);
  const test::Workshop shop;
  const test::Outcome run =
      test::kiln(shop, {"preview", (folder / "data/materials/rock_Rock020_1k_dx").string(), "--env",
                        (folder / "data/env/venice_sunset_1k.hdr").string(), "-o",
                        (shop / "ball.exr").string(), "--shape", "sphere", "--size", "64"});
  ASSERT_EQ(run.code, 0) << run.err;
  const Layers ball = colors_of(shop / "ball.exr");
  const Plane& red = *ball.find("R");
  double left = 0, right = 0;
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 32; ++x) {
      left += red.at(x, y);
      right += red.at(63 - x, y);
    }
  }
  EXPECT_GT(left, 1.3 * right);
}

}  // namespace
}  // namespace kiln

// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "kiln/image/compare.h"
#include "kiln/io/image_file.h"
#include "kiln/material/naming.h"
#include "kiln/material/workflow.h"
#include "support/real_data.h"

namespace kiln {
namespace {

namespace fs = std::filesystem;

float srgb_to_linear(float v) {
  return v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f);
}

void linearize(Layers& image) {
  for (Layer& layer : image.layers) {
    for (int y = 0; y < image.size.height; ++y) {
      for (int x = 0; x < image.size.width; ++x) {
        layer.plane.at(x, y) = srgb_to_linear(layer.plane.at(x, y));
      }
    }
  }
}

// The maps of a found set, as a pipeline loads them.
SlotMaps load(const fs::path& folder, const FoundSet& set) {
  std::map<std::string, Layers> files;
  SlotMaps maps;
  for (const MapSource& source : set.maps) {
    if (!files.count(source.file)) files[source.file] = read_image(folder / source.file).image;
    const Layers& file = files.at(source.file);
    std::vector<std::string> names;
    for (const Layer& layer : file.layers) names.push_back(layer.name);
    if (source.if_present && !has_channels(names, source.channels)) continue;
    SlotMap& map = maps[source.slot];
    map.image = pick_slot(file, source.slot, source.channels);
    map.convention = source.convention;
    map.source = source.file;
    if (source.color_space == "srgb_rec709_scene") linearize(map.image);
  }
  return maps;
}

std::vector<FoundSet> sets_in(const fs::path& folder) {
  std::vector<std::string> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    files.push_back(entry.path().filename().string());
  }
  return find_sets(folder.filename().string(), files);
}

struct Scan {
  FoundSet set;
  Resolved resolved;
};

std::vector<Scan> resolve_folder(const fs::path& folder) {
  std::vector<Scan> scans;
  for (const FoundSet& set : sets_in(folder)) {
    scans.push_back({set, resolve(load(folder, set), {.workflow = set.workflow})});
  }
  return scans;
}

Layers as_image(const std::array<Plane, 3>& planes) {
  return {planes[0].size(), {{"R", planes[0]}, {"G", planes[1]}, {"B", planes[2]}}};
}

double mean_of(const Plane& plane) {
  double sum = 0;
  for (int y = 0; y < plane.height(); ++y) {
    for (const float v : plane.texels_of_row(y)) sum += v;
  }
  return sum / static_cast<double>(area(plane.size()));
}

std::array<Plane, 3> normals_in(const fs::path& file) {
  return decode_normals(read_image(file).image, {}).normal;
}

TEST(RealScans, TellOpenGlFromDirectXByTheirHeightMaps) {
  KILN_REQUIRE_REAL_DATA(data);
  const fs::path materials = data / "data" / "materials";
  const fs::path rusty = materials / "rusty_metal_Metal053C_1k_gl";
  const ConventionGuess metal =
      guess_convention(normals_in(rusty / "normal.jpg"),
                       read_image(rusty / "displacement.jpg").image.layers[0].plane);
  EXPECT_EQ(metal.convention, NormalConvention::OpenGl);
  EXPECT_NEAR(metal.correlation_x, -0.784, 0.02);
  EXPECT_NEAR(metal.correlation_y, 0.792, 0.02);
  const fs::path rock = materials / "rock_Rock020_1k_dx";
  const ConventionGuess stone =
      guess_convention(normals_in(rock / "Rock020_1K_Normal.jpg"),
                       read_image(rock / "Rock020_1K_Displacement.jpg").image.layers[0].plane);
  EXPECT_EQ(stone.convention, NormalConvention::DirectX);
  EXPECT_NEAR(stone.correlation_x, -0.961, 0.02);
  EXPECT_NEAR(stone.correlation_y, -0.953, 0.02);
}

TEST(RealScans, TellOpenGlFromDirectXByTheNormalsAlone) {
  KILN_REQUIRE_REAL_DATA(data);
  const fs::path materials = data / "data" / "materials";
  const ConventionGuess metal =
      guess_convention(normals_in(materials / "rusty_metal_Metal053C_1k_gl" / "normal.jpg"));
  EXPECT_EQ(metal.convention, NormalConvention::OpenGl) << metal.reason;
  const ConventionGuess stone =
      guess_convention(normals_in(materials / "rock_Rock020_1k_dx" / "Rock020_1K_Normal.jpg"));
  EXPECT_EQ(stone.convention, NormalConvention::DirectX) << stone.reason;
}

TEST(RealScans, OfCopperHaveNormalsWithoutDirectionThatAreCounted) {
  KILN_REQUIRE_REAL_DATA(data);
  const auto file =
      data / "data" / "materials" / "copper_tiles_01_2k" / "Copper_tiles_01_Normal.png";
  const DecodedNormals decoded = decode_normals(read_image(file).image, {});
  EXPECT_GT(decoded.degenerate, 0);
  EXPECT_GT(decoded.not_unit, decoded.degenerate);
  EXPECT_EQ(decoded.below_surface, 0);
  EXPECT_FALSE(decoded.two_channel);
  EXPECT_NEAR(mean_of(decoded.normal[0]), 0.0047, 0.01);
  EXPECT_NEAR(mean_of(decoded.normal[1]), 0.0051, 0.01);
}

TEST(RealScans, OfThePanelAgreeBetweenItsTwoWorkflows) {
  KILN_REQUIRE_REAL_DATA(data);
  const auto scans = resolve_folder(data / "data" / "materials" / "panel_gltf_mr_and_specgloss_1k");
  ASSERT_EQ(scans.size(), 2u);
  const Svbrdf& metal = scans[0].resolved.svbrdf;
  const Svbrdf& gloss = scans[1].resolved.svbrdf;
  const auto expect_alike = [](const Layers& a, const Layers& b, const char* what) {
    const Difference difference = compare(a, b);
    EXPECT_LT(difference.mean, 0.005) << what;
    EXPECT_LT(difference.percentile_95, 0.02) << what;
    testing::Test::RecordProperty(std::string(what) + "_mean", std::to_string(difference.mean));
    testing::Test::RecordProperty(std::string(what) + "_p95",
                                  std::to_string(difference.percentile_95));
  };
  expect_alike(as_image(metal.diffuse_color), as_image(gloss.diffuse_color), "diffuse");
  expect_alike(as_image(metal.f0), as_image(gloss.f0), "f0");
  expect_alike({metal.size, {{"r", metal.roughness}}}, {gloss.size, {{"r", gloss.roughness}}},
               "roughness");
  EXPECT_EQ(compare(as_image(metal.normal), as_image(gloss.normal)).max, 0);
}

TEST(RealScans, OfTheRockComeOutWithGreenTurnedUp) {
  KILN_REQUIRE_REAL_DATA(data);
  const auto folder = data / "data" / "materials" / "rock_Rock020_1k_dx";
  const auto scans = resolve_folder(folder);
  ASSERT_EQ(scans.size(), 1u);
  const auto stored = normals_in(folder / "Rock020_1K_Normal.jpg");
  EXPECT_EQ(scans[0].resolved.svbrdf.normal[1].at(100, 200), -stored[1].at(100, 200));
  EXPECT_THAT(scans[0].resolved.notes,
              testing::Contains(testing::HasSubstr("normal: DirectX (y down), by the height map")));
}

TEST(RealScans, OfFabricWithoutNormalsAreFlatAndOfTheColoursSize) {
  KILN_REQUIRE_REAL_DATA(data);
  const auto scans =
      resolve_folder(data / "data" / "materials" / "fabric_Fabric02_2048x2463_nonormal");
  ASSERT_EQ(scans.size(), 1u);
  EXPECT_EQ(scans[0].resolved.svbrdf.size, (Size{2048, 2463}));
  EXPECT_EQ(scans[0].resolved.svbrdf.normal[2].at(1000, 2000), 1.0f);
  EXPECT_THAT(scans[0].resolved.notes, testing::Contains("normal: no map, flat"));
}

TEST(RealScans, OfTheBoomBoxReportEmissiveAsNotRendered) {
  KILN_REQUIRE_REAL_DATA(data);
  const auto scans = resolve_folder(data / "data" / "materials" / "boombox_gltf_orm_2k");
  ASSERT_EQ(scans.size(), 1u);
  EXPECT_THAT(scans[0].resolved.notes, testing::Contains("emissive: not rendered, ignored"));
  EXPECT_TRUE(std::none_of(scans[0].set.maps.begin(), scans[0].set.maps.end(),
                           [](const MapSource& map) { return map.reason.empty(); }));
}

}  // namespace
}  // namespace kiln

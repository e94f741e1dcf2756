// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <sstream>

#include "brute_force.h"
#include "kiln/image/arrangement.h"
#include "kiln/image/compare.h"
#include "kiln/image/resample.h"
#include "kiln/io/image_file.h"
#include "kiln/light/radiance.h"
#include "kiln/light/source.h"
#include "kiln/light/spherical_harmonics.h"
#include "support/real_data.h"

namespace kiln {
namespace {

/// Mean radiance, irradiance over pi on +X -X +Y -Y +Z -Z, nine harmonics.
using Expected = std::vector<double>;

/// Lines "file,width,height,channel,numbers ..." by file, in the order R G B.
std::map<std::string, std::vector<Expected>> read_expected(const std::filesystem::path& path) {
  std::map<std::string, std::vector<Expected>> expected;
  std::ifstream file(path);
  std::string line;
  while (std::getline(file, line)) {
    if (line.starts_with('#') || line.starts_with("file,")) continue;
    std::istringstream fields(line);
    std::string name, field;
    std::getline(fields, name, ',');
    for (int skipped = 0; skipped < 3; ++skipped) std::getline(fields, field, ',');
    Expected numbers;
    while (std::getline(fields, field, ',')) numbers.push_back(std::stod(field));
    expected[name].push_back(numbers);
  }
  return expected;
}

double color(const Vec3<double>& value, size_t c) {
  return c == 0 ? value.x : c == 1 ? value.y : value.z;
}

/// What read_expected lists, computed.
std::vector<Expected> compute(const Layers& image) {
  const std::vector<Vec3<double>> axes = {{1, 0, 0},  {-1, 0, 0}, {0, 1, 0},
                                          {0, -1, 0}, {0, 0, 1},  {0, 0, -1}};
  const Vec3<double> mean = mean_radiance(image);
  const auto irradiance = irradiance_over_pi(image, axes);
  const auto harmonics = project_sh(image, 2).coefficients;
  std::vector<Expected> found(3);
  for (size_t c = 0; c < 3; ++c) {
    found[c].push_back(color(mean, c));
    for (const auto& value : irradiance) found[c].push_back(color(value, c));
    for (const auto& value : harmonics) found[c].push_back(color(value, c));
  }
  return found;
}

TEST(RealEnvironments, HaveTheKnownMeanIrradianceAndHarmonics) {
  KILN_REQUIRE_REAL_DATA(folder);
  const auto environments = folder / "data" / "env";
  const auto expected = read_expected(environments / "EXPECTED_env.csv");
  ASSERT_FALSE(expected.empty());
  for (const auto& [name, channels] : expected) {
    const std::vector<Expected> found = compute(read_image(environments / name).image);
    ASSERT_EQ(channels.size(), 3u) << name;
    for (size_t c = 0; c < 3; ++c) {
      const double scale = std::abs(channels[c][7]);  // L00
      ASSERT_EQ(channels[c].size(), found[c].size()) << name;
      for (size_t i = 0; i < found[c].size(); ++i) {
        EXPECT_NEAR(found[c][i], channels[c][i], 1e-4 * scale) << name << " " << c << " " << i;
      }
    }
  }
}

TEST(RealEnvironments, AreFilteredNearlyAsByBruteForce) {
  KILN_REQUIRE_REAL_DATA(folder);
  for (const char* name : {"studio_small_03_1k.hdr", "venice_sunset_1k.hdr"}) {
    const Layers image = read_image(folder / "data" / "env" / name).image;
    const SpecularChain chain(image, {.size = 256});
    const test::BruteForce truth(image);
    const Vec3<double> mean = mean_radiance(image);
    for (int level = 1; level < chain.levels(); ++level) {
      const auto probed = test::probe(chain.size(level), 200, test::brightest_direction(image));
      const auto random = test::error_of(chain, level, truth, mean, probed.random);
      const auto near = test::error_of(chain, level, truth, mean, probed.near);
      EXPECT_LT(random.rms, 3e-5) << name << ", level " << level;
      EXPECT_LT(random.max, 3e-4) << name << ", level " << level;
      EXPECT_LT(near.max, 2e-3) << name << ", level " << level;
      RecordProperty(std::string(name) + "_" + std::to_string(level), std::to_string(random.rms));
    }
  }
}

TEST(RealEnvironments, WithNanAndInfAreMadeFinite) {
  KILN_REQUIRE_REAL_DATA(folder);
  Layers image = read_image(folder / "data" / "env" / "BrightRingsNanInf.exr").image;
  const Fixed found = fix_radiance(image, Fix::Neighbors);
  EXPECT_GT(found.nan + found.inf, 0);
  const Oddities left = count_oddities(image);
  EXPECT_EQ(left.nan + left.inf, 0);
}

SphereImage read_sphere(const std::filesystem::path& path) {
  ImageFile file = read_image(path, {}, {"R", "G", "B"});
  const ImageMarks marks{file.facts.size, file.facts.envmap, file.facts.node_aligned};
  const ArrangementChoice choice = choose_arrangement(Arrangement::Auto, marks);
  return arranged(std::move(file.image), choice.arrangement, marks);
}

/// Seen from afar: the lines of two renderings differ by less than a texel.
Layers from_afar(const Layers& latlong) { return resample(latlong, {64, 32}); }

// Two renderings of one scene, with letters: a turned or mirrored face would differ everywhere.
TEST(RealEnvironments, AreTheSameFromACubeAndFromALatLongImage) {
  KILN_REQUIRE_REAL_DATA(folder);
  for (const std::string name : {"Orientation", "WavyLines"}) {
    const auto env = folder / "data" / "env";
    SphereImage cube = read_sphere(env / (name + "Cube.exr"));
    const SphereImage latlong = read_sphere(env / (name + "LatLong.exr"));
    ASSERT_EQ(cube.projection, SphereImage::Projection::Cube);
    ASSERT_TRUE(latlong.node_aligned);
    const Layers expected = from_afar(texel_centred(latlong.images.front()));
    const double same = compare(from_afar(picture_of(cube)), expected).rms;
    mirror_x(cube);
    const double mirrored = compare(from_afar(picture_of(cube)), expected).rms;
    EXPECT_LT(same, 0.02) << name;
    EXPECT_GT(mirrored, 3 * same) << name;
    RecordProperty(name, std::to_string(same) + " " + std::to_string(mirrored));
  }
}

TEST(RealEnvironments, HaveTheMomentsOfTheLatLongImageInTheCube) {
  KILN_REQUIRE_REAL_DATA(folder);
  const auto env = folder / "data" / "env";
  const auto of_cube = project_sh(point_masses_of(read_sphere(env / "OrientationCube.exr")), 1);
  const auto expected =
      project_sh(texel_centred(read_sphere(env / "OrientationLatLong.exr").images.front()), 1);
  for (size_t i = 0; i < expected.coefficients.size(); ++i) {
    EXPECT_NEAR(of_cube.coefficients[i].y, expected.coefficients[i].y,
                3e-3 * expected.coefficients[0].y)
        << i;
  }
}

}  // namespace
}  // namespace kiln

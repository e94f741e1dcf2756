// SPDX-License-Identifier: Apache-2.0
// The shipped textures are what their generator paints, and what they claim to be.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "environments.h"
#include "kiln/image/projection.h"
#include "kiln/io/image_file.h"
#include "support/places.h"
#include "support/temporary_folder.h"
#include "surface.h"

namespace kiln::textures {
namespace {

namespace fs = std::filesystem;

const fs::path shipped = test::source_folder() / "textures";

std::string bytes_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// Largest difference of two planes.
double distance(const Plane& a, const Plane& b) {
  double largest = 0;
  for (int y = 0; y < a.height(); ++y) {
    for (int x = 0; x < a.width(); ++x) {
      largest = std::max(largest, static_cast<double>(std::abs(a.at(x, y) - b.at(x, y))));
    }
  }
  return largest;
}

void expect_same_texels(const fs::path& a, const fs::path& b) {
  const Layers left = read_image(a).image, right = read_image(b).image;
  ASSERT_EQ(left.size, right.size) << a;
  ASSERT_EQ(left.layers.size(), right.layers.size()) << a;
  for (size_t i = 0; i < left.layers.size(); ++i) {
    EXPECT_EQ(distance(left.layers[i].plane, right.layers[i].plane), 0)
        << a << ' ' << left.layers[i].name;
  }
}

/// Mean of a * b over the tile, for planes of mean zero a covariance.
double mean_product(const Plane& a, const Plane& b) {
  double sum = 0;
  for (int y = 0; y < a.height(); ++y) {
    for (int x = 0; x < a.width(); ++x) sum += static_cast<double>(a.at(x, y)) * b.at(x, y);
  }
  return sum / static_cast<double>(area(a.size()));
}

/// Central differences of the heights around the borders, along (dx, dy).
Plane slope(const Plane& height, int dx, int dy) {
  const Size size = height.size();
  Plane result(size);
  const auto at = [&](int x, int y) {
    return height.at((x + size.width) % size.width, (y + size.height) % size.height);
  };
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x)
      result.at(x, y) = (at(x + dx, y + dy) - at(x - dx, y - dy)) / 2;
  }
  return result;
}

Plane centred(Plane plane) {
  for (int y = 0; y < plane.height(); ++y) {
    for (int x = 0; x < plane.width(); ++x) plane.at(x, y) -= 0.5f;
  }
  return plane;
}

double correlation(const Plane& a, const Plane& b) {
  return mean_product(a, b) / std::sqrt(mean_product(a, a) * mean_product(b, b));
}

TEST(ShippedTextures, AreWhatTheirGeneratorPaints) {
  const test::TemporaryFolder scratch;
  const Set set = brushed_steel();
  write_set(set, scratch.folder());
  for (const MapFile& file : set.files) {
    expect_same_texels(shipped / set.folder / file.name, scratch.folder() / set.folder / file.name);
  }
}

TEST(ShippedTextures, OfTheStudioAreWhatTheirGeneratorPaints) {
  const test::TemporaryFolder scratch;
  write_surroundings(studio(), scratch.folder());
  expect_same_texels(shipped / "env" / "studio.exr", scratch.folder() / "env" / "studio.exr");
}

TEST(ShippedTextures, ComeOutByteForByteTheSameTwice) {
  const test::TemporaryFolder first, second;
  for (const test::TemporaryFolder* scratch : {&first, &second})
    write_surroundings(studio(), scratch->folder());
  EXPECT_EQ(bytes_of(first.folder() / "env" / "studio.exr"),
            bytes_of(second.folder() / "env" / "studio.exr"));
}

TEST(ShippedTextures, HaveNormalsThatPointUpInTheGreenChannelAsTheHeightsSay) {
  for (const std::string name : {"woven_fabric", "painted_panel"}) {
    const Layers normal = read_image(shipped / name / (name + "_normal.png")).image;
    const Plane height =
        read_image(shipped / name / (name + "_height.png")).image.layers.at(0).plane;
    EXPECT_LT(correlation(centred(normal.layers.at(0).plane), slope(height, 1, 0)), -0.9) << name;
    EXPECT_GT(correlation(centred(normal.layers.at(1).plane), slope(height, 0, 1)), 0.9) << name;
  }
}

TEST(ShippedSky, HoldsTheEnergyOfASunOfTrueStrength) {
  const Layers image = read_image(shipped / "env" / "sky.exr").image;
  const auto luminance_at = [&](int x, int y) {
    return luminance(Vec3<double>{image.layers[0].plane.at(x, y), image.layers[1].plane.at(x, y),
                                  image.layers[2].plane.at(x, y)});
  };
  const double zenith = luminance_at(0, 0);
  double sun = 0;
  for (int y = 0; y < image.size.height; ++y) {
    for (int x = 0; x < image.size.width; ++x) {
      const double value = luminance_at(x, y);
      if (value > 100 * zenith) sun += value * latlong_texel_solid_angle(image.size, y);
    }
  }
  const double disc = 2 * pi * (1 - std::cos(sun_diameter_rad / 2));
  EXPECT_NEAR(sun / (disc * zenith), sun_over_zenith, 0.002 * sun_over_zenith);
}

TEST(ShippedEnvironments, AreBrighterOnTheSideOfPlusX) {
  const Layers image = read_image(shipped / "env" / "studio.exr").image;
  double left_red = 0, left_blue = 0, right_red = 0, right_blue = 0;
  for (int y = 0; y < image.size.height; ++y) {
    for (int x = 0; x < image.size.width / 2; ++x) {
      const double weight = latlong_texel_solid_angle(image.size, y);
      const int mirrored = image.size.width - 1 - x;
      left_red += weight * image.layers[0].plane.at(x, y);
      left_blue += weight * image.layers[2].plane.at(x, y);
      right_red += weight * image.layers[0].plane.at(mirrored, y);
      right_blue += weight * image.layers[2].plane.at(mirrored, y);
    }
  }
  EXPECT_GT(left_red, 1.3 * left_blue);
  EXPECT_GT(right_blue, 1.05 * right_red);
}

}  // namespace
}  // namespace kiln::textures

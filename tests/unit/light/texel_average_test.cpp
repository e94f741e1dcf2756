// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "kiln/light/irradiance.h"
#include "kiln/light/prefilter.h"
#include "synthetic.h"

namespace kiln {
namespace {

double solid_angle_of(SphereLayout layout, Size size, int x, int y) {
  switch (layout) {
    case SphereLayout::Cube:
      return cube_texel_solid_angle(size.width, x, y);
    case SphereLayout::LatLong:
      return latlong_texel_solid_angle(size, y);
    case SphereLayout::Octahedral:
      return octahedral_texel_solid_angle(size.width, x, y);
  }
  return 0;
}

double mean_of(const std::vector<Layers>& images, SphereLayout layout) {
  double sum = 0;
  for (const Layers& image : images) {
    for (int y = 0; y < image.size.height; ++y) {
      for (int x = 0; x < image.size.width; ++x) {
        sum += image.layers[1].plane.at(x, y) * solid_angle_of(layout, image.size, x, y);
      }
    }
  }
  return sum / (4 * pi);
}

constexpr std::array layouts = {SphereLayout::Cube, SphereLayout::LatLong,
                                SphereLayout::Octahedral};

TEST(TexelAverage, KeepsAConstantToRounding) {
  for (const auto& [layout, at_nodes] : {std::pair{SphereLayout::Cube, false},
                                         {SphereLayout::LatLong, false},
                                         {SphereLayout::Octahedral, false},
                                         {SphereLayout::Cube, true},
                                         {SphereLayout::LatLong, true}}) {
    for (const Size size : {Size{256, 128}, Size{63, 31}, Size{1024, 512}}) {
      for (const Layers& image :
           average_over_texels(test::constant_environment(size, 0.7), {layout, 32, at_nodes})) {
        for (int y = 0; y < image.size.height; ++y) {
          for (const float value : image.layers[0].plane.texels_of_row(y)) {
            ASSERT_NEAR(value, 0.7, 2e-6);
          }
        }
      }
    }
  }
}

// Suns of a single texel, wherever they stand, and a lamp of a few.
TEST(TexelAverage, KeepsTheMeanOverTheSphere) {
  for (const SphereLayout layout : layouts) {
    for (std::uint32_t i = 0; i < 12; ++i) {
      const Size size{256, 128};
      Layers image = test::constant_environment(size, 0.2);
      const Vec2<double> uv = direction_to_latlong(test::random_direction(3, i));
      const int x = static_cast<int>(uv.x * size.width), y = static_cast<int>(uv.y * size.height);
      for (Layer& layer : image.layers) {
        layer.plane.at(x, y) = 1e4f;
        for (int k = 0; k < 9; ++k) {
          layer.plane.at((x + 90 + k % 3) % size.width, std::min(y + k / 3, 127)) += 50;
        }
      }
      const double mean = mean_radiance(image).y;
      for (const int edge : {16, 32, 64}) {
        EXPECT_NEAR(mean_of(average_over_texels(image, {layout, edge}), layout), mean, 1e-5 * mean)
            << sphere_layout_names[static_cast<size_t>(layout)] << " " << edge << " " << i;
      }
    }
  }
}

TEST(TexelAverage, IsNearTheMeanOfFinePoints) {
  const Layers image = test::environment_of({512, 256}, [](const Vec3<double>& d) {
    const double value = 1 + std::sin(12 * d.x) * std::cos(9 * d.y + d.z);
    return Vec3<double>{value, value, value};
  });
  constexpr int edge = 64, points = 40;
  const auto faces = average_over_texels(image, {SphereLayout::Cube, edge});
  for (int face = 0; face < 6; ++face) {
    for (const auto& [x, y] : {std::pair{0, 0}, {3, 17}, {31, 32}, {63, 8}}) {
      double sum = 0, weights = 0;
      for (int k = 0; k < points * points; ++k) {
        const Vec2<double> uv{(x + (k % points + 0.5) / points) / edge,
                              (y + (k / points + 0.5) / points) / edge};
        const Vec3<double> d = cube_to_direction(static_cast<CubeFace>(face), uv);
        const double weight = std::pow(length(d), -3);
        const Vec3<double> unit = normalize(d);
        sum += weight * (1 + std::sin(12 * unit.x) * std::cos(9 * unit.y + unit.z));
        weights += weight;
      }
      // Top and bottom are looked up bilinearly in half as many texels, a little softer.
      const bool side = face < 2 || face > 3;
      EXPECT_NEAR(faces[static_cast<size_t>(face)].layers[0].plane.at(x, y), sum / weights,
                  side ? 6e-3 : 2e-2)
          << face << " " << x << " " << y;
    }
  }
}

TEST(TexelAverage, LeavesALatLongImageOfThatSizeAsItIs) {
  const Layers image = test::sunny_environment({64, 32}, 1e3);
  const Layers same = average_over_texels(image, {SphereLayout::LatLong, 32})[0];
  for (int y = 0; y < 32; ++y) {
    for (int x = 0; x < 64; ++x) {
      const float value = image.layers[0].plane.at(x, y);
      ASSERT_NEAR(same.layers[0].plane.at(x, y), value, 1e-6 * value);
    }
  }
}

TEST(TexelAverage, LeavesAnEvenLampEvenOnFinerTexels) {
  const Layers image = test::environment_of({128, 64}, [](const Vec3<double>& d) {
    const double value = d.y > 0.8 || (d.x > 0.8 && d.y < 0.3) ? 10 : 0.1;
    return Vec3<double>{value, value, value};
  });
  for (const int edge : {24, 40, 64, 256}) {
    const auto faces = average_over_texels(image, {.size = edge});
    for (const CubeFace face : {CubeFace::px, CubeFace::py}) {
      const Plane& plane = faces[static_cast<size_t>(face)].layers[0].plane;
      for (const double u : {0.45, 0.5, 0.55}) {
        const int x = static_cast<int>(u * edge);
        EXPECT_NEAR(plane.at(x, edge / 2), 10, 0.1) << edge;
      }
    }
  }
}

}  // namespace
}  // namespace kiln

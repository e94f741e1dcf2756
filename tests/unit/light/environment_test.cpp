// SPDX-License-Identifier: Apache-2.0
#include "kiln/light/environment.h"

#include <gtest/gtest.h>

#include <limits>

#include "kiln/core/error.h"
#include "synthetic.h"

namespace kiln {
namespace {

using test::random_direction;
using test::random_unit;
using test::sunny_environment;

Vec3<float> to_float(const Vec3<double>& d) {
  return {static_cast<float>(d.x), static_cast<float>(d.y), static_cast<float>(d.z)};
}

/// A node-aligned image of the function 2 + (1, 2, 3).d.
Layers node_aligned_image(Size size) {
  Layers image = make_layers(size, {"R", "G", "B"});
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const Vec3<double> d =
          latlong_to_direction(Vec2<double>{x / (size.width - 1.0), y / (size.height - 1.0)});
      for (Layer& layer : image.layers) {
        layer.plane.at(x, y) = static_cast<float>(4 + d.x + 2 * d.y + 3 * d.z);
      }
    }
  }
  return image;
}

TEST(Environment, ReturnsATexelAtItsCentre) {
  const Layers image = sunny_environment({64, 32}, 100);
  const Environment environment(image);
  for (int y = 0; y < 32; ++y) {
    for (int x = 0; x < 64; ++x) {
      const Vec3<double> found = environment.radiance(test::texel_direction(image.size, x, y));
      EXPECT_NEAR(found.x, image.layers[0].plane.at(x, y), 1e-4);
      EXPECT_NEAR(found.z, image.layers[2].plane.at(x, y), 1e-4);
    }
  }
}

TEST(Environment, IsContinuousWhereTheImageWrapsAround) {
  const Environment environment(sunny_environment({64, 32}, 100));
  const auto at = [&](double u) {
    return environment.radiance(latlong_to_direction(Vec2<double>{u, 0.4})).y;
  };
  EXPECT_NEAR(at(1e-9), at(1 - 1e-9), 1e-6);
}

TEST(Environment, TurnsWhatWasAtPlusZTowardPlusX) {
  const Layers image = sunny_environment({64, 32}, 100);
  const Environment still(image), turned(image, {.rotate_deg = 90});
  const Vec3<double> at_z = still.radiance(Vec3<double>{0.1, 0.2, 0.97});
  const Vec3<double> at_x = turned.radiance(Vec3<double>{0.97, 0.2, -0.1});
  EXPECT_NEAR(at_z.x, at_x.x, 1e-6);
  EXPECT_NEAR(at_z.y, at_x.y, 1e-6);
  EXPECT_NEAR(still.density(Vec3<double>{0.1, 0.2, 0.97}),
              turned.density(Vec3<double>{0.97, 0.2, -0.1}), 1e-9);
}

TEST(Environment, TakesAnyTurn) {
  const Layers image = sunny_environment({64, 32}, 100);
  const Environment a(image, {.rotate_deg = -75}), b(image, {.rotate_deg = 285 + 720});
  const Vec3<double> d = random_direction(0, 0);
  EXPECT_NEAR(a.radiance(d).x, b.radiance(d).x, 1e-6);
}

TEST(Environment, SurvivesPolesAndWhatIsNoDirection) {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  constexpr float inf = std::numeric_limits<float>::infinity();
  const Environment environment(sunny_environment({16, 8}, 100), {.rotate_deg = 30});
  for (const Vec3<float>& d : {Vec3<float>{0, 1, 0},
                               {0, -1, 0},
                               {0, 0, -1},
                               {-0.0f, 0, -1},
                               {nan, nan, nan},
                               {0, 0, 0},
                               {inf, 0, 0},
                               {1e30f, -1e30f, 1e30f},
                               {nan, 1, 0}}) {
    environment.radiance(d);
    EXPECT_GT(environment.density(d), 0);
    environment.radiance(Vec3<WideFloat>{WideFloat(d.x), WideFloat(d.y), WideFloat(d.z)});
    environment.density(Vec3<WideFloat>{WideFloat(d.x), WideFloat(d.y), WideFloat(d.z)});
  }
  for (const float u : {0.0f, 1.0f, -1.0f, 2.0f, 0.99999994f}) {
    const auto sample = environment.sample(Vec2<float>{u, u});
    EXPECT_NEAR(length(sample.direction), 1, 1e-6);
    EXPECT_GT(sample.density, 0);
  }
}

TEST(Environment, ReadsNodeAlignedImagesAtTheirNodes) {
  const Layers image = node_aligned_image({33, 17});
  const Environment environment(image, {.node_aligned = true});
  for (int y = 1; y < 16; ++y) {
    for (int x = 0; x < 33; ++x) {
      const Vec3<double> d = latlong_to_direction(Vec2<double>{x / 32.0, y / 16.0});
      EXPECT_NEAR(environment.radiance(d).x, image.layers[0].plane.at(x, y), 1e-5);
    }
  }
  EXPECT_NEAR(environment.radiance(Vec3<double>{0, 1, 0}).x, 6, 1e-5);
  EXPECT_EQ(environment.cells(), (Size{32, 16}));
}

void expect_density_integrates_to_one(const Environment& environment) {
  const Size cells = environment.cells();
  double sum = 0;
  for (int y = 0; y < cells.height; ++y) {
    for (int x = 0; x < cells.width; ++x) {
      sum += environment.density(test::texel_direction(cells, x, y)) *
             latlong_texel_solid_angle(cells, y);
    }
  }
  EXPECT_NEAR(sum, 1, 1e-5);
}

TEST(EnvironmentDensity, IntegratesToOne) {
  expect_density_integrates_to_one(Environment(sunny_environment({128, 64}, 1e4)));
  expect_density_integrates_to_one(Environment(sunny_environment({100, 37}, 1e6)));
  expect_density_integrates_to_one(
      Environment(node_aligned_image({65, 33}), {.node_aligned = true}));
  expect_density_integrates_to_one(Environment(test::constant_environment({32, 16}, 0)));
  expect_density_integrates_to_one(Environment(test::constant_environment({1, 1}, 1)));
}

TEST(EnvironmentDensity, OfAConstantEnvironmentIsUniform) {
  const Environment environment(test::constant_environment({64, 32}, 3));
  for (std::uint32_t i = 0; i < 100; ++i) {
    EXPECT_NEAR(environment.density(random_direction(3, i)) * 4 * pi, 1, 1e-4);
  }
}

TEST(EnvironmentDensity, IsPositiveEvenWhereThePlannedShareRoundsToNothing) {
  const Environment environment(sunny_environment({256, 128}, 1e9));
  for (std::uint32_t i = 0; i < 1000; ++i) {
    EXPECT_GE(environment.density(random_direction(4, i)) * 4 * pi,
              0.999 * Environment::uniform_share);
  }
}

TEST(EnvironmentSample, StatesTheDensityAndRadianceOfItsDirection) {
  const Environment environment(sunny_environment({128, 64}, 1e3), {.rotate_deg = 40});
  int off_by_a_cell = 0;
  for (std::uint32_t i = 0; i < 10000; ++i) {
    const Vec2<double> u{random_unit(5, 2 * i), random_unit(5, 2 * i + 1)};
    const LightSample<double> sample = environment.sample(u);
    EXPECT_NEAR(length(sample.direction), 1, 1e-12);
    off_by_a_cell += std::abs(environment.density(sample.direction) / sample.density - 1) > 1e-6;
    const Vec3<double> radiance = environment.radiance(sample.direction);
    EXPECT_NEAR(sample.radiance.x, radiance.x, 1e-4 * (1 + radiance.x));
  }
  EXPECT_LT(off_by_a_cell, 5) << "rounding may move a direction across the edge of its cell";
}

TEST(EnvironmentSample, KeepsStrataInOrder) {
  const Environment environment(sunny_environment({64, 32}, 50));
  const double u_fixed = 0.37;
  double height = 2, turn = -1;
  for (int i = 0; i < 1000; ++i) {
    const double u = (i + 0.5) / 1000;
    const double y = environment.sample(Vec2<double>{u_fixed, 0.01 + 0.99 * u}).direction.y;
    EXPECT_LE(y, height + 1e-7);
    height = y;
    const auto sample = environment.sample(Vec2<double>{u, 0.5});
    const double next = direction_to_latlong(sample.direction).x;
    EXPECT_GE(next, turn);
    turn = next;
  }
}

TEST(EnvironmentLookups, AreTheSameForWideNumbers) {
  const Environment environment(sunny_environment({128, 64}, 1e3), {.rotate_deg = 123});
  constexpr int lanes = lane_count<WideFloat>;
  for (std::uint32_t block = 0; block < 200; ++block) {
    float a[lanes], b[lanes];
    for (std::uint32_t i = 0; i < lanes; ++i) {
      a[i] = static_cast<float>(random_unit(6, 2 * (block * lanes + i)) * 0.9999999);
      b[i] = static_cast<float>(random_unit(6, 2 * (block * lanes + i) + 1) * 0.9999999);
    }
    const auto wide =
        environment.sample(Vec2<WideFloat>{load_lanes<WideFloat>(a), load_lanes<WideFloat>(b)});
    const WideFloat again = environment.density(wide.direction);
    const WideFloat green = environment.radiance(wide.direction).y;
    for (std::size_t i = 0; i < lanes; ++i) {
      const auto one = environment.sample(Vec2<float>{a[i], b[i]});
      EXPECT_FLOAT_EQ(one.direction.x, wide.direction.x.get(i));
      EXPECT_FLOAT_EQ(one.radiance.y, wide.radiance.y.get(i));
      EXPECT_FLOAT_EQ(one.density, wide.density.get(i));
      EXPECT_FLOAT_EQ(environment.density(one.direction), again.get(i));
      EXPECT_FLOAT_EQ(environment.radiance(one.direction).y, green.get(i));
    }
  }
}

TEST(EnvironmentLookups, InFloatFollowThoseInDouble) {
  const Environment environment(sunny_environment({128, 64}, 10), {.rotate_deg = 123});
  for (std::uint32_t i = 0; i < 2000; ++i) {
    const Vec3<double> d = random_direction(8, i);
    EXPECT_NEAR(environment.radiance(to_float(d)).x, environment.radiance(d).x, 1e-3);
  }
}

TEST(Environment, RefusesImagesThatAreNoEnvironment) {
  EXPECT_THROW(Environment(Layers{}), Error);
  EXPECT_THROW(Environment(make_layers({4, 2}, {"R", "G"})), Error);
  EXPECT_THROW(Environment(make_layers({1, 1}, {"R", "G", "B"}), {.node_aligned = true}), Error);
}

TEST(Environment, TakesAGreyImage) {
  Layers grey{{8, 4}, {}};
  grey.add("Y", 0.25f);
  EXPECT_FLOAT_EQ(Environment(grey).radiance(Vec3<float>{0, 0, 1}).z, 0.25f);
}

}  // namespace
}  // namespace kiln

// SPDX-License-Identifier: Apache-2.0
#include "kiln/light/irradiance.h"

#include <gtest/gtest.h>

#include "kiln/image/projection.h"
#include "kiln/parallel/threads.h"
#include "synthetic.h"

namespace kiln {
namespace {

using test::random_direction;

TEST(MeanRadiance, WeighsTexelsByTheirSolidAngle) {
  const Layers image = test::environment_of({64, 32}, [](const Vec3<double>& d) {
    return Vec3<double>{1, d.y > 0 ? 2.0 : 0.0, d.y * d.y};
  });
  const Vec3<double> mean = mean_radiance(image);
  EXPECT_NEAR(mean.x, 1, 1e-12);
  EXPECT_NEAR(mean.y, 1, 1e-12);
  EXPECT_NEAR(mean.z, 1.0 / 3, 1e-3);
}

TEST(Irradiance, OfALinearEnvironmentIsKnown) {
  const Vec3<double> a{0.3, -0.5, 0.8};
  const Layers image = test::environment_of({512, 256}, [&](const Vec3<double>& d) {
    const double value = 2 + dot(d, a);
    return Vec3<double>{value, 2 * value, 3 * value};
  });
  for (std::uint32_t i = 0; i < 8; ++i) {
    const Vec3<double> n = random_direction(0, i);
    EXPECT_NEAR(irradiance_over_pi(image, n).y, 4 + 4.0 / 3 * dot(n, a), 1e-4);
  }
}

TEST(Irradiance, OfManyNormalsIsThatOfEach) {
  for (const Size size : {Size{128, 64}, Size{61, 33}}) {
    const Layers image = test::sunny_environment(size, 1e4);
    const double mean = mean_radiance(image).x;
    std::vector<Vec3<double>> normals = {{0, 1, 0},  {0, -1, 0}, {1, 0, 0},
                                         {-1, 0, 0}, {0, 0, 1},  {0, 0, -1}};
    for (std::uint32_t i = 0; i < 200; ++i) normals.push_back(random_direction(1, i));
    const auto found = irradiance_over_pi(image, normals);
    for (size_t i = 0; i < normals.size(); ++i) {
      const Vec3<double> expected = irradiance_over_pi(image, normals[i]);
      EXPECT_NEAR(found[i].x, expected.x, 1e-12 * mean);
      EXPECT_NEAR(found[i].z, expected.z, 1e-12 * mean);
    }
  }
}

TEST(IrradianceMap, KeepsAConstantEnvironment) {
  const IrradianceMap map(test::constant_environment({64, 32}, 0.7));
  for (std::uint32_t i = 0; i < 200; ++i) {
    EXPECT_NEAR(map.lookup(random_direction(2, i)).x, 0.7, 1e-6);
  }
}

TEST(IrradianceMap, IsNearTheIrradianceOfAnyNormal) {
  const Layers image = test::sunny_environment({128, 64}, 100);
  const IrradianceMap map(image);
  const double mean = mean_radiance(image).y;
  for (std::uint32_t i = 0; i < 100; ++i) {
    const Vec3<double> n = random_direction(3, i);
    EXPECT_NEAR(map.lookup(n).y, irradiance_over_pi(image, n).y, 5e-3 * mean);
  }
}

TEST(IrradianceMap, IsContinuousAcrossThePoles) {
  const IrradianceMap map(test::sunny_environment({128, 64}, 1e4));
  for (const double pole : {1.0, -1.0}) {
    for (int i = 0; i < 16; ++i) {
      const double phi = 2 * pi * i / 16, s = 1e-7;
      const Vec3<double> a{s * std::cos(phi), pole, s * std::sin(phi)};
      const Vec3<double> b{-a.x, a.y, -a.z};
      EXPECT_NEAR(map.lookup(a).x, map.lookup(b).x, 1e-4 * map.lookup(a).x);
    }
  }
}

TEST(IrradianceMap, TurnsWithTheEnvironment) {
  const Layers image = test::sunny_environment({128, 64}, 100);
  const IrradianceMap still(image), turned(image, 90);
  EXPECT_NEAR(still.lookup(Vec3<double>{0, 0, 1}).x, turned.lookup(Vec3<double>{1, 0, 0}).x, 1e-9);
}

TEST(IrradianceMap, IsTheSameForWideNumbers) {
  const IrradianceMap map(test::sunny_environment({128, 64}, 100), 30);
  for (std::uint32_t i = 0; i < 100; ++i) {
    const Vec3<double> n = random_direction(4, i);
    const Vec3<float> one{static_cast<float>(n.x), static_cast<float>(n.y),
                          static_cast<float>(n.z)};
    const Vec3<WideFloat> wide{WideFloat(one.x), WideFloat(one.y), WideFloat(one.z)};
    EXPECT_FLOAT_EQ(map.lookup(one).x, map.lookup(wide).x.get(0));
  }
}

TEST(IrradianceMap, DoesNotDependOnTheThreads) {
  const Layers image = test::sunny_environment({64, 32}, 100);
  const auto with_threads = [&](int threads) {
    const ThreadLimit limit(threads);
    return IrradianceMap(image);
  };
  const IrradianceMap one = with_threads(1), two = with_threads(2);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 128; ++x) {
      ASSERT_EQ(one.image().layers[1].plane.at(x, y), two.image().layers[1].plane.at(x, y));
    }
  }
}

}  // namespace
}  // namespace kiln

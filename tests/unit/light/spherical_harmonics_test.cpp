// SPDX-License-Identifier: Apache-2.0
#include "kiln/light/spherical_harmonics.h"

#include <gtest/gtest.h>

#include "kiln/light/irradiance.h"
#include "kiln/parallel/threads.h"
#include "synthetic.h"

namespace kiln {
namespace {

using test::random_direction;

// The first nine in closed form.
std::vector<double> nine_harmonics(const Vec3<double>& d) {
  const double a = std::sqrt(3 / (4 * pi)), b = std::sqrt(15 / (4 * pi));
  return {std::sqrt(1 / (4 * pi)),
          a * d.y,
          a * d.z,
          a * d.x,
          b * d.x * d.y,
          b * d.y * d.z,
          std::sqrt(5 / (16 * pi)) * (3 * d.z * d.z - 1),
          b * d.x * d.z,
          std::sqrt(15 / (16 * pi)) * (d.x * d.x - d.y * d.y)};
}

TEST(SphericalHarmonics, AreTheClosedFormsUpToOrderTwo) {
  for (std::uint32_t i = 0; i < 100; ++i) {
    const Vec3<double> d = random_direction(0, i);
    const auto found = harmonics_at(2, d), expected = nine_harmonics(d);
    for (size_t k = 0; k < 9; ++k) EXPECT_NEAR(found[k], expected[k], 1e-15);
  }
}

TEST(SphericalHarmonics, SatisfyTheAdditionTheorem) {
  const Vec3<double> d = random_direction(1, 0);
  const auto values = harmonics_at(32, d);
  for (int l = 0; l <= 32; ++l) {
    double sum = 0;
    for (int m = -l; m <= l; ++m) sum += square(values[static_cast<size_t>(l * l + l + m)]);
    EXPECT_NEAR(sum, (2 * l + 1) / (4 * pi), 1e-12) << l;
  }
}

TEST(SphericalHarmonics, OfAnExpansionAreItsCoefficients) {
  // 1 + y + 2 z + 3 x + x y, whose harmonics are plain.
  const Layers image = test::environment_of({512, 256}, [](const Vec3<double>& d) {
    const double value = 1 + d.y + 2 * d.z + 3 * d.x + d.x * d.y;
    return Vec3<double>{value, 2 * value, -value};
  });
  const SphericalHarmonics found = project_sh(image, 3);
  const double a = std::sqrt(4 * pi / 3), b = std::sqrt(4 * pi / 15);
  const std::vector<double> expected = {std::sqrt(4 * pi), a, 2 * a, 3 * a, b, 0, 0, 0, 0};
  for (size_t k = 0; k < 16; ++k) {
    const double value = k < 9 ? expected[k] : 0;
    EXPECT_NEAR(found.coefficients[k].x, value, 2e-4) << k;
    EXPECT_NEAR(found.coefficients[k].y, 2 * value, 4e-4) << k;
    EXPECT_NEAR(found.coefficients[k].z, -value, 2e-4) << k;
  }
}

TEST(SphericalHarmonics, SeeLightFromPlusXAsPositiveL11) {
  const Layers image = test::environment_of({64, 32}, [](const Vec3<double>& d) {
    const double value = d.x > 0.99 ? 1 : 0;
    return Vec3<double>{value, value, value};
  });
  const SphericalHarmonics found = project_sh(image, 1);
  EXPECT_GT(found.coefficients[3].x, 0.9 * found.coefficients[0].x);
  EXPECT_NEAR(found.coefficients[1].x, 0, 1e-9);
  EXPECT_NEAR(found.coefficients[2].x, 0, 1e-9);
}

TEST(SphericalHarmonics, GiveTheIrradianceOfALinearEnvironmentExactly) {
  const Layers image = test::environment_of({512, 256}, [](const Vec3<double>& d) {
    const double value = 2 + dot(d, Vec3<double>{0.3, -0.5, 0.8});
    return Vec3<double>{value, value, value};
  });
  const SphericalHarmonics irradiance = irradiance_over_pi(project_sh(image, 2));
  for (std::uint32_t i = 0; i < 50; ++i) {
    const Vec3<double> n = random_direction(2, i);
    const double expected = 2 + 2.0 / 3 * dot(n, Vec3<double>{0.3, -0.5, 0.8});
    EXPECT_NEAR(evaluate(irradiance, n).x, expected, 1e-4);
  }
}

TEST(SphericalHarmonics, ConvergeToTheIrradianceOfASun) {
  const Layers image = test::sunny_environment({128, 64}, 100);
  const SphericalHarmonics irradiance = irradiance_over_pi(project_sh(image, 24));
  const double mean = mean_radiance(image).x;
  for (std::uint32_t i = 0; i < 50; ++i) {
    const Vec3<double> n = random_direction(3, i);
    EXPECT_NEAR(evaluate(irradiance, n).x, irradiance_over_pi(image, n).x, 3e-3 * mean);
  }
}

TEST(SphericalHarmonics, DoNotDependOnTheThreads) {
  const Layers image = test::sunny_environment({128, 64}, 100);
  const auto with_threads = [&](int threads) {
    const ThreadLimit limit(threads);
    return project_sh(image, 4);
  };
  const SphericalHarmonics one = with_threads(1), two = with_threads(2);
  for (size_t k = 0; k < one.coefficients.size(); ++k) {
    EXPECT_EQ(one.coefficients[k].x, two.coefficients[k].x);
  }
}

TEST(SphericalHarmonics, AreThoseOfTheTexelsOneByOne) {
  for (const Size size : {Size{64, 32}, Size{45, 21}}) {
    const Layers image = test::sunny_environment(size, 50);
    for (const Axes& axes : {Axes{}, parse_axes("z,-x,y")}) {
      const SphericalHarmonics found = project_sh(image, 4, axes);
      std::vector<double> expected(25);
      for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) {
          const auto values = harmonics_at(4, axes.to_engine(test::texel_direction(size, x, y)));
          const double power = image.layers[1].plane.at(x, y) * latlong_texel_solid_angle(size, y);
          for (size_t i = 0; i < 25; ++i) expected[i] += values[i] * power;
        }
      }
      for (size_t i = 0; i < 25; ++i) {
        EXPECT_NEAR(found.coefficients[i].y, expected[i], 1e-12 * expected[0]);
      }
    }
  }
}

TEST(SphericalHarmonics, ScaledForShadersGiveTheSameSumAsAPolynomial) {
  const SphericalHarmonics sum = project_sh(test::sunny_environment({64, 32}, 50), 2);
  const auto c = scaled_for_shaders(sum);
  for (std::uint32_t i = 0; i < 20; ++i) {
    const Vec3<double> n = test::random_direction(5, i);
    const double polynomial = c[0].x + c[1].x * n.y + c[2].x * n.z + c[3].x * n.x +
                              c[4].x * n.x * n.y + c[5].x * n.y * n.z +
                              c[6].x * (3 * n.z * n.z - 1) + c[7].x * n.x * n.z +
                              c[8].x * (n.x * n.x - n.y * n.y);
    EXPECT_NEAR(polynomial, evaluate(sum, n).x, 1e-12);
  }
}

TEST(SphericalHarmonics, AreDampedByWindowsButForTheMean) {
  const SphericalHarmonics sum = project_sh(test::sunny_environment({64, 32}, 50), 3);
  for (const ShWindow window : {ShWindow::Hann, ShWindow::Lanczos}) {
    const SphericalHarmonics damped = windowed(sum, window);
    EXPECT_EQ(damped.coefficients[0].x, sum.coefficients[0].x);
    EXPECT_LT(std::abs(damped.coefficients[9].x), std::abs(sum.coefficients[9].x));
  }
  EXPECT_NEAR(windowed(sum, ShWindow::Hann).coefficients[5].x, 0.5 * sum.coefficients[5].x, 1e-15);
  EXPECT_EQ(windowed(sum, ShWindow::None).coefficients[5].x, sum.coefficients[5].x);
}

}  // namespace
}  // namespace kiln

// SPDX-License-Identifier: Apache-2.0
#include "kiln/light/control_lobes.h"

#include <gtest/gtest.h>

#include "kiln/parallel/rows.h"
#include "synthetic.h"

namespace kiln {
namespace {

Vec3<double> some_direction(std::uint32_t i) {
  const double z = 2 * test::random_unit(11, 2 * i) - 1, r = std::sqrt(1 - z * z);
  const double phi = 2 * pi * test::random_unit(11, 2 * i + 1);
  return {r * std::cos(phi), z, r * std::sin(phi)};
}

constexpr Size grid{2048, 1024};

/// The sum over the sphere of f(direction, radiance) dw, by the midpoint rule.
template <class Visit>
Vec3<double> integrate(const Environment& environment, const Visit& f) {
  const auto sums = sum_rows(grid.height, 3, [&](int y, std::vector<double>& share) {
    const double solid_angle = latlong_texel_solid_angle(grid, y);
    for (int x = 0; x < grid.width; ++x) {
      const Vec3<double> w =
          latlong_to_direction(Vec2<double>{(x + 0.5) / grid.width, (y + 0.5) / grid.height});
      const double value = f(w) * solid_angle;
      const Vec3<double> radiance = environment.radiance(w);
      share[0] += radiance.x * value;
      share[1] += radiance.y * value;
      share[2] += radiance.z * value;
    }
  });
  return {sums[0], sums[1], sums[2]};
}

Vec3<double> mean_of(const Environment& environment) {
  return integrate(environment, [](const Vec3<double>&) { return 1 / (4 * pi); });
}

void expect_near(const Vec3<double>& found, const Vec3<double>& expected,
                 const Vec3<double>& tolerance) {
  EXPECT_NEAR(found.x, expected.x, tolerance.x);
  EXPECT_NEAR(found.y, expected.y, tolerance.y);
  EXPECT_NEAR(found.z, expected.z, tolerance.z);
}

// The known integral is that of the mixture times the environment as it is looked up.
TEST(ControlLobes, IntegralsAreThoseOfTheMixtures) {
  for (const double rotate_deg : {0.0, 70.0}) {
    const Environment environment(test::sunny_environment({128, 64}, 50), {false, rotate_deg});
    const ControlLobes controls(environment);
    const Vec3<double> tolerance = mean_of(environment) * 1e-4;
    for (std::uint32_t i = 0; i < 3; ++i) {
      const Vec3<double> d = some_direction(i);
      for (const double alpha : {0.06, 0.37}) {
        const auto lobes = controls.lobes(d, alpha);
        expect_near(lobes.light, integrate(environment, lobes), tolerance);
      }
      const auto cosines = controls.cosines(d);
      expect_near(cosines.light, integrate(environment, cosines), tolerance);
    }
  }
}

// Nodes of an image with repeated borders lie elsewhere than texels.
TEST(ControlLobes, IntegralsHoldForNodeAlignedImages) {
  const Environment environment(test::constant_environment({65, 33}, 2), {true, 0});
  const ControlLobes controls(environment);
  const auto lobes = controls.lobes(some_direction(3), 0.2);
  expect_near(lobes.light, {2, 2, 2}, {1e-5, 1e-5, 1e-5});
}

// Four lobes mixed are like one between them: the whole point of a control variate.
TEST(ControlLobes, MixturesAreLikeTheLobeAsked) {
  const Environment environment(test::constant_environment({64, 32}, 1));
  const ControlLobes controls(environment);
  for (const double alpha : {0.04, 0.1, 0.3, 0.6, 1.0}) {
    double integral = 0;
    for (int i = 0; i < 20000; ++i) {
      const double c = (i + 0.5) / 20000;
      integral += 2 * pi * straight_lobe(alpha * alpha, c, 0.5 - 0.5 * c) / 20000;
    }
    for (std::uint32_t i = 0; i < 20; ++i) {
      const Vec3<double> d = some_direction(i);
      const auto mixture = controls.lobes(d, alpha);
      const double peak = straight_lobe(alpha * alpha, 1.0, 0.0) / integral;
      EXPECT_NEAR(mixture(d), peak, 0.12 * peak) << alpha;
    }
  }
}

}  // namespace
}  // namespace kiln

// SPDX-License-Identifier: Apache-2.0
#include "kiln/light/angles.h"

#include <gtest/gtest.h>

#include "synthetic.h"

namespace kiln {
namespace {

TEST(Angles, AgreeWithTheArcTangentAllAround) {
  for (int i = 0; i < 100000; ++i) {
    const double angle = pi * (2 * test::random_unit(0, static_cast<std::uint32_t>(i)) - 1);
    const auto y = static_cast<float>(std::sin(angle)), x = static_cast<float>(std::cos(angle));
    EXPECT_NEAR(turns_of(y, x), std::atan2(double{y}, double{x}) / (2 * pi), 6e-8);
  }
}

TEST(Angles, AreThoseOfTheAxes) {
  EXPECT_EQ(turns_of(0.0f, 1.0f), 0.0f);
  EXPECT_EQ(turns_of(0.0f, -1.0f), 0.5f);
  EXPECT_EQ(turns_of(1.0f, 0.0f), 0.25f);
  EXPECT_EQ(turns_of(-1.0f, 0.0f), -0.25f);
  EXPECT_EQ(turns_of(0.0f, 0.0f), 0.0f);
}

TEST(Angles, HaveSineAndCosineToAFewUlp) {
  for (int i = 0; i < 100000; ++i) {
    const auto turns =
        static_cast<float>(4 * test::random_unit(1, static_cast<std::uint32_t>(i)) - 2);
    const auto found = sine_cosine_of_turns(turns);
    EXPECT_NEAR(found.sine, std::sin(2 * pi * turns), 1.2e-7) << turns;
    EXPECT_NEAR(found.cosine, std::cos(2 * pi * turns), 1.2e-7) << turns;
  }
}

TEST(Angles, GiveTheLatLongPointOfADirection) {
  for (std::uint32_t i = 0; i < 10000; ++i) {
    const Vec3<double> d = test::random_direction(2, i);
    const Vec2<double> expected = direction_to_latlong(d);
    const Vec2<float> found = latlong_of(
        Vec3<float>{static_cast<float>(d.x), static_cast<float>(d.y), static_cast<float>(d.z)});
    // Rounding d moves u more and more toward the poles.
    const double sine = std::sqrt(1 - d.y * d.y);
    EXPECT_NEAR(found.x, expected.x, 1.5e-7 + 3e-8 / sine);
    EXPECT_NEAR(found.y, expected.y, 1.5e-7);
  }
}

}  // namespace
}  // namespace kiln

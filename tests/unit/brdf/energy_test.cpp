// SPDX-License-Identifier: Apache-2.0
#include "kiln/brdf/energy.h"

#include <gtest/gtest.h>

#include "kiln/brdf/surface.h"

namespace kiln {
namespace {

TEST(MultipleScattering, OfAWhiteLobeReturnsAllThatIsLost) {
  // F = 1: single bounce E plus F_ms (1 - E) is 1 for every direction.
  for (const double average : {0.4, 0.7, 0.99}) {
    EXPECT_NEAR(multiple_scattering_color(1.0, average), 1, 1e-12);
  }
}

TEST(MultipleScattering, IsAbsentWhereNothingIsLost) {
  const Albedo<double> albedo{{1, 0}, {1, 0}, {1, 0}};
  EXPECT_EQ(multiple_scattering(albedo), 0);
}

TEST(Coupling, UnderAMirrorThatReflectsAllIsZero) {
  const SpecularChannel<double> mirror{1, 1, 1};
  const Albedo<double> albedo{{0.6, 0.1}, {0.5, 0.2}, {0.6, 0.1}};
  EXPECT_NEAR(coupling(mirror, albedo, true), 0, 1e-12);
  EXPECT_NEAR(coupling(mirror, albedo, false), 0, 1e-12);
}

TEST(Coupling, OfAnyLobeNeverExceedsWhatIsLeft) {
  const SpecularChannel<double> plastic{0.04, 1, 0.01};
  const Albedo<double> albedo{{0.2, 0.7}, {0.9, 0.05}, {0.8, 0.1}};
  EXPECT_LE(coupling(plastic, albedo, false), 1 - plastic.reflectance(albedo.o));
}

TEST(SchlickFresnel, AverageIsOneTwentyFirstOfTheWayToGrazing) {
  const auto fresnel = schlick_of<double>({0.04, 0.5, 1}, 1.0);
  EXPECT_NEAR(fresnel.average().x, 0.04 + 0.96 / 21, 1e-15);
  EXPECT_NEAR(fresnel.average().y, 0.5 + 0.5 / 21, 1e-15);
  EXPECT_NEAR(fresnel.average().z, 1, 1e-15);
}

TEST(SchlickFresnel, RunsFromF0ToF90) {
  const auto fresnel = schlick_of<double>({0.04, 0.5, 1}, 1.0);
  EXPECT_DOUBLE_EQ(fresnel.eval(1.0).x, 0.04);
  EXPECT_DOUBLE_EQ(fresnel.eval(0.0).x, 1);
}

}  // namespace
}  // namespace kiln

// SPDX-License-Identifier: Apache-2.0
#include "kiln/material/lobe_error.h"

#include <gtest/gtest.h>

#include <cmath>

#include "kiln/brdf/slopes.h"

namespace kiln {
namespace {

TEST(LobeError, OfALobeThatAllTexelsShareIsNothing) {
  const auto normal = normalize(Vec3<float>{0.3f, -0.2f, 1});
  Facets facets;
  for (int i = 0; i < 13; ++i) facets.add(normal, 0.4f);
  const LobeError error = lobe_error(facets, {normal, 0.16f, 0.16f, 0}, 256, 1);
  EXPECT_NEAR(error.peak, 0, 1e-4);
  EXPECT_NEAR(error.rms, 0, 1e-3);
}

TEST(LobeError, OfALobeThatMeetsNoTexelIsThatOfBothTogether) {
  const auto left = normalize(Vec3<float>{-1, 0, 1}), right = normalize(Vec3<float>{1, 0, 1});
  Facets facets;
  facets.add(left, 0.1f);
  const LobeError error = lobe_error(facets, {right, 0.01f, 0.01f, 0}, 1024, 2);
  EXPECT_NEAR(error.peak, 0, 1e-3);
  EXPECT_NEAR(error.rms, std::sqrt(2.0), 0.05);
}

// D = 1 / (pi alpha^2) (1 + t^2 / alpha^2)^-2 in slopes t: for alpha << 1 the integral of the
// product of two lobes about one normal is one over s = t^2.
TEST(LobeError, OfALobeTwiceAsWideIsThatOfItsFormula) {
  const Vec3<float> up{0, 0, 1};
  Facets facets;
  facets.add(up, std::sqrt(0.02f));
  const LobeError error = lobe_error(facets, {up, 0.04f, 0.04f, 0}, 4096, 3);
  EXPECT_NEAR(error.peak, -0.75, 1e-3);
  // (1/a) / (1 + s/a)^2 squared and multiplied, of a = 1 and 4.
  double equal = 0, wide = 0, both = 0;
  constexpr int steps = 400000;
  for (int i = 0; i < steps; ++i) {
    const double u = (i + 0.5) / steps, s = u / (1 - u), ds = 1 / ((1 - u) * (1 - u) * steps);
    const double d = 1 / ((1 + s) * (1 + s)), e = 0.25 / ((1 + s / 4) * (1 + s / 4));
    equal += d * d * ds;
    wide += e * e * ds;
    both += d * e * ds;
  }
  EXPECT_NEAR(error.rms, std::sqrt((equal + wide - 2 * both) / equal), 0.03);
}

TEST(LobeError, KnowsHowAnisotropicLobesAreTurned) {
  Facets facets;
  const float angle = 0.2f;
  const float c = std::cos(0.2f * 3.14159265f), s = std::sin(0.2f * 3.14159265f);
  for (const float slope : {-0.3f, -0.2f, -0.1f, 0.0f, 0.1f, 0.2f, 0.3f}) {
    facets.add(normal_of_slopes(slope * c, slope * s), 0.4f);
  }
  const auto rms = [&](float turned) {
    return lobe_error(facets, {{0, 0, 1}, 0.32f, 0.16f, turned}, 1024, 4).rms;
  };
  EXPECT_LT(rms(angle), 0.3);
  EXPECT_GT(rms(angle + 0.5f), 0.4);
}

}  // namespace
}  // namespace kiln

// SPDX-License-Identifier: Apache-2.0
#include "prefilter.h"

#include <gtest/gtest.h>

#include "brute_force.h"

namespace kiln {
namespace {

using test::BruteForce;
using test::LevelError;

void expect_levels_near_brute_force(const Layers& image, const Layers& truth_image, int size) {
  const SpecularChain chain(image, {.size = size});
  const BruteForce truth(truth_image);
  const Vec3<double> mean = mean_radiance(truth_image);
  for (int level = 1; level < chain.levels(); ++level) {
    const auto probed = test::probe(chain.size(level), 200, test::brightest_direction(truth_image));
    const LevelError random = test::error_of(chain, level, truth, mean, probed.random);
    const LevelError near = test::error_of(chain, level, truth, mean, probed.near);
    EXPECT_LT(random.rms, 2e-5) << "level " << level;
    EXPECT_LT(random.max, 2e-4) << "level " << level;
    EXPECT_LT(near.max, 2e-3) << "level " << level;
  }
}

TEST(Prefilter, IsNearBruteForceAroundASunAndElsewhere) {
  const Layers image = test::sunny_environment({256, 128}, 1e4);
  expect_levels_near_brute_force(image, image, 64);
}

TEST(Prefilter, IsNearBruteForceForSizesThatAreNoPowersOfTwo) {
  const Layers image = test::sunny_environment({250, 127}, 300);
  expect_levels_near_brute_force(image, image, 48);
}

TEST(Prefilter, FirstMakesACoarseSourceFinerForASharpLobe) {
  const Layers image = test::sunny_environment({48, 24}, 30);
  // The levels of a chain of 64, 32 and 16 by the filament curve.
  const Refinement times = refinement_for(
      image.size, {{.size = 32, .alpha = square(1 - std::sqrt(0.5))}, {.size = 16, .alpha = 1}});
  EXPECT_GE(48 * times.across, 2 * 6 / 0.0858);
  expect_levels_near_brute_force(image, finer(image, times), 64);
}

TEST(Prefilter, LeavesNoUndershootInTheDark) {
  const Layers image = test::environment_of({256, 128}, [](const Vec3<double>& d) {
    const double value = d.x > 0.9995 ? 1e4 : 0;
    return Vec3<double>{value, value, value};
  });
  const SpecularChain chain(image, {.size = 64});
  for (int level = 0; level < chain.levels(); ++level) {
    for (int face = 0; face < 6; ++face) {
      const Layers texels = chain.face(level, static_cast<CubeFace>(face));
      for (int y = 0; y < chain.size(level); ++y) {
        for (float value : texels.layers[0].plane.texels_of_row(y)) ASSERT_GE(value, 0);
      }
    }
  }
}

TEST(Prefilter, KeepsNegativeRadianceLinear) {
  const Layers image = test::environment_of({128, 64}, [](const Vec3<double>& d) {
    return Vec3<double>{d.x, 1 + d.x, 1 - d.x};
  });
  const SpecularChain chain(image, {.size = 32});
  for (int face = 0; face < 6; ++face) {
    const Layers texels = chain.face(1, static_cast<CubeFace>(face));
    for (int y = 0; y < 16; ++y) {
      for (int x = 0; x < 16; ++x) {
        ASSERT_NEAR(texels.layers[0].plane.at(x, y) + 1, texels.layers[1].plane.at(x, y), 1e-5);
        ASSERT_NEAR(1 - texels.layers[0].plane.at(x, y), texels.layers[2].plane.at(x, y), 1e-5);
      }
    }
  }
}

}  // namespace
}  // namespace kiln

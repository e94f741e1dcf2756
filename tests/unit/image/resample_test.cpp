// SPDX-License-Identifier: Apache-2.0
#include "kiln/image/resample.h"

#include <gtest/gtest.h>

#include <cmath>

#include "kiln/core/error.h"
#include "kiln/image/compare.h"

namespace kiln {
namespace {

Plane ramp(Size size) {
  Plane plane(size);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      plane.at(x, y) = (x + 0.5f) / static_cast<float>(size.width);
    }
  }
  return plane;
}

double mean(const Plane& plane) {
  double sum = 0;
  for (int y = 0; y < plane.height(); ++y) {
    for (float value : plane.texels_of_row(y)) sum += value;
  }
  return sum / static_cast<double>(area(plane.size()));
}

TEST(Resample, KeepsAConstant) {
  for (const Size size : {Size{3, 5}, Size{64, 48}, Size{17, 130}}) {
    const Plane result = resample(Plane({31, 47}, 0.7f), size);
    for (int y = 0; y < size.height; ++y) {
      for (float value : result.texels_of_row(y)) EXPECT_NEAR(value, 0.7f, 1e-6);
    }
  }
}

TEST(Resample, KeepsTheMeanWhereItShrinks) {
  const Plane plane = ramp({61, 33});
  EXPECT_NEAR(mean(resample(plane, {13, 7})), mean(plane), 1e-6);
}

TEST(Resample, AlignsTexelCentresWhereItGrows) {
  const Plane fine = resample(ramp({8, 4}), {32, 16});
  for (int x = 2; x < 30; ++x) EXPECT_NEAR(fine.at(x, 5), (x + 0.5) / 32, 1e-6);
}

TEST(Resample, HalvesAveragingFourTexels) {
  Plane plane({2, 2});
  plane.at(0, 0) = 1;
  plane.at(1, 1) = 3;
  EXPECT_FLOAT_EQ(halve(plane).at(0, 0), 1.0f);
}

TEST(Compare, FindsNoDifferenceBetweenAnImageAndItself) {
  Layers image = make_layers({9, 9}, {"R", "G"});
  image.layers[1].plane = ramp({9, 9});
  EXPECT_EQ(compare(image, image).max, 0);
}

TEST(Compare, StatesMeanRmsAndGreatestDifference) {
  Layers a = make_layers({2, 2}, {"Y"}), b = a;
  b.layers[0].plane.at(0, 0) = 2;
  const Difference difference = compare(a, b);
  EXPECT_DOUBLE_EQ(difference.mean, 0.5);
  EXPECT_DOUBLE_EQ(difference.rms, 1.0);
  EXPECT_DOUBLE_EQ(difference.max, 2.0);
}

TEST(Compare, RefusesImagesOfDifferentSizes) {
  EXPECT_THROW(compare(make_layers({2, 2}, {"Y"}), make_layers({2, 3}, {"Y"})), Error);
}

TEST(Layers, CountWhatIsNotFiniteOrNegative) {
  Layers image = make_layers({4, 1}, {"Y"});
  image.layers[0].plane.at(0, 0) = NAN;
  image.layers[0].plane.at(1, 0) = -INFINITY;
  image.layers[0].plane.at(2, 0) = -1;
  const Oddities found = count_oddities(image);
  EXPECT_EQ(found.nan, 1);
  EXPECT_EQ(found.inf, 1);
  EXPECT_EQ(found.negative, 2);
}

}  // namespace
}  // namespace kiln

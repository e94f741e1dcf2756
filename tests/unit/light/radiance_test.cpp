// SPDX-License-Identifier: Apache-2.0
#include "kiln/light/radiance.h"

#include <gtest/gtest.h>

#include <limits>

#include "kiln/core/error.h"
#include "synthetic.h"

namespace kiln {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float infinite = std::numeric_limits<float>::infinity();

Layers counting_image(Size size) {
  Layers image = make_layers(size, {"R"});
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      image.layers[0].plane.at(x, y) = static_cast<float>(10 * y + x);
    }
  }
  return image;
}

TEST(FixRadiance, ReplacesByTheMeanOfTheEightNeighbours) {
  Layers image = counting_image({8, 4});
  image.layers[0].plane.at(3, 2) = nan;
  const Fixed fixed = fix_radiance(image, Fix::Neighbors);
  EXPECT_EQ(fixed.nan, 1);
  EXPECT_EQ(fixed.inf, 0);
  EXPECT_FLOAT_EQ(image.layers[0].plane.at(3, 2), 23);
}

TEST(FixRadiance, WrapsAroundTheImageAndEndsAtThePoles) {
  Layers image = counting_image({8, 4});
  image.layers[0].plane.at(0, 0) = infinite;
  const Fixed fixed = fix_radiance(image, Fix::Neighbors);
  EXPECT_EQ(fixed.inf, 1);
  // Columns 7, 0 and 1 of rows 0 and 1.
  EXPECT_FLOAT_EQ(image.layers[0].plane.at(0, 0), (7 + 1 + 17 + 10 + 11) / 5.0f);
}

TEST(FixRadiance, EndsAtTheEdgesOfAFace) {
  Layers image = counting_image({8, 8});
  image.layers[0].plane.at(0, 0) = infinite;
  fix_radiance(image, Fix::Neighbors, Edges::End);
  EXPECT_FLOAT_EQ(image.layers[0].plane.at(0, 0), (1 + 10 + 11) / 3.0f);
}

TEST(FixRadiance, SaysWhereTheFirstIsFound) {
  Layers image = counting_image({70, 4});
  image.layers[0].plane.at(66, 2) = nan;
  image.layers[0].plane.at(5, 3) = nan;
  const Fixed found = fix_radiance(image, Fix::None);
  ASSERT_TRUE(found.first);
  EXPECT_EQ(found.first->x, 66);
  EXPECT_EQ(found.first->y, 2);
  EXPECT_EQ(found.first->channel, "R");
  EXPECT_FALSE(fix_radiance(image, Fix::Zero).first == std::nullopt);
  EXPECT_FALSE(fix_radiance(image, Fix::Zero).first) << "nothing is left";
}

TEST(FixRadiance, GrowsItsRingUntilItFindsSomethingFinite) {
  Layers image = counting_image({16, 9});
  for (int y = 3; y <= 5; ++y) {
    for (int x = 6; x <= 8; ++x) image.layers[0].plane.at(x, y) = nan;
  }
  EXPECT_EQ(fix_radiance(image, Fix::Neighbors).nan, 9);
  EXPECT_FLOAT_EQ(image.layers[0].plane.at(7, 4), 47);
}

TEST(FixRadiance, WritesZeroOrNothingWhenAskedTo) {
  Layers image = counting_image({8, 4});
  image.layers[0].plane.at(2, 1) = infinite;
  image.layers[0].plane.at(3, 1) = -1;
  const Fixed counted = fix_radiance(image, Fix::None);
  EXPECT_EQ(counted.inf, 1);
  EXPECT_EQ(counted.negative, 1);
  EXPECT_EQ(image.layers[0].plane.at(2, 1), infinite);
  fix_radiance(image, Fix::Zero);
  EXPECT_EQ(image.layers[0].plane.at(2, 1), 0);
  EXPECT_EQ(image.layers[0].plane.at(3, 1), -1) << "negative radiance is kept";
}

TEST(FixRadiance, MakesAChannelWithoutAnyFiniteValueZero) {
  Layers image = make_layers({4, 2}, {"R"});
  for (int y = 0; y < 2; ++y) {
    for (int x = 0; x < 4; ++x) image.layers[0].plane.at(x, y) = nan;
  }
  EXPECT_EQ(fix_radiance(image, Fix::Neighbors).nan, 8);
  EXPECT_EQ(image.layers[0].plane.at(1, 1), 0);
}

TEST(TexelCentred, AveragesTheFourCornersOfEachTexel) {
  const Layers centred = texel_centred(counting_image({5, 3}));
  EXPECT_EQ(centred.size, (Size{4, 2}));
  EXPECT_FLOAT_EQ(centred.layers[0].plane.at(2, 1), 17.5f);
}

TEST(TexelCentred, RefusesAnImageWithoutTwoRowsAndColumns) {
  EXPECT_THROW(texel_centred(counting_image({1, 3})), Error);
}

}  // namespace
}  // namespace kiln

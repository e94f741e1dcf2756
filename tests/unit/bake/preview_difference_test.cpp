// SPDX-License-Identifier: Apache-2.0
#include "preview_difference.h"

#include <gtest/gtest.h>

#include "support/scenes.h"

namespace kiln {
namespace {

// A ramp of differences from -1 to 1 along x.
Layers ramp(Size size) {
  Layers image = make_layers(size, {"R", "G", "B", "A"});
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      for (size_t c = 0; c < 3; ++c) {
        image.layers[c].plane.at(x, y) = 2 * (x + 0.5f) / static_cast<float>(size.width) - 1;
      }
      image.layers[3].plane.at(x, y) = 1;
    }
  }
  return image;
}

TEST(DifferenceView, IsRedWhereTooBrightBlueWhereTooDarkAndWhiteBetween) {
  const Layers painted = paint_difference(ramp({101, 4}), 1);
  const auto at = [&](int x, size_t c) { return painted.layers[c].plane.at(x, 1); };
  EXPECT_GT(at(90, 0), at(90, 2) + 0.3f);
  EXPECT_GT(at(10, 2), at(10, 0) + 0.3f);
  for (size_t c = 0; c < 3; ++c) EXPECT_GT(at(50, c), 0.93f);
  for (int x = 1; x < 51; ++x) EXPECT_GE(at(x, 0), at(x - 1, 0)) << x;
  for (int x = 51; x < 101; ++x) EXPECT_LE(at(x, 2), at(x - 1, 2) + 0.02f) << x;
}

TEST(DifferenceView, HasARoundScaleThatHoldsNearlyEverything) {
  const Layers image = ramp({256, 16});
  EXPECT_DOUBLE_EQ(difference_scale({&image}), 1);
  Layers small = image;
  for (size_t c = 0; c < 3; ++c) {
    for (int y = 0; y < 16; ++y) {
      for (int x = 0; x < 256; ++x) small.layers[c].plane.at(x, y) *= 0.013f;
    }
  }
  EXPECT_NEAR(difference_scale({&small}), 0.02, 1e-12);
  small.layers[0].plane.at(3, 3) = 1e6f;
  EXPECT_NEAR(difference_scale({&small}), 0.02, 1e-12);
  const Layers black = make_layers({8, 8}, {"R", "G", "B", "A"});
  EXPECT_GT(difference_scale({&black}), 0);
}

TEST(DifferenceView, HasALegendBelowThePictureWhateverItsSize) {
  for (const Size size : {Size{256, 64}, Size{24, 24}, Size{1, 1}}) {
    const Layers view = difference_view(ramp(size));
    EXPECT_EQ(view.size.width, size.width);
    EXPECT_GT(view.size.height, size.height);
    EXPECT_EQ(view.find("A")->at(0, view.size.height - 1), 1);
    const Oddities odd = count_oddities(view);
    EXPECT_EQ(odd.nan + odd.inf + odd.negative, 0);
  }
}

TEST(DifferencePreview, KeepsItsSignsInNumbersAndHasAViewForTheEye) {
  const Layers lamp = test::make_latlong({128, 64}, [](const Vec3<double>& d) {
    return dot(d, {0, 0.6, 0.8}) > 0.97 ? 50.0 : 0.1;
  });
  const test::Settings settings = {{"mode", "difference"}, {"shape", "sphere"}, {"size", "64"}};
  const Baked baked =
      test::bake_preview(test::uniform_svbrdf({.f0 = 0.5f, .roughness = 0.6f}), lamp, settings);
  const Artifact& made = baked.artifacts.at(0);
  EXPECT_GT(count_oddities(made.image).negative, 100);
  ASSERT_TRUE(made.view.has_value());
  EXPECT_EQ(count_oddities(*made.view).negative, 0);
  EXPECT_NE(made.image.find("stderr.R"), nullptr);
  EXPECT_EQ(baked.figures.at(1).first, "mean difference");
}

TEST(DifferencePreview, IsLargestWhereTheApproximationIsWorst) {
  // Split-sum filters around the mirrored direction as if seen from there: right at normal
  // incidence but for the width of the lobe, wrong toward the rim of a rough ball.
  const Layers lamp =
      test::make_latlong({128, 64}, [](const Vec3<double>& d) { return std::exp(4 * (d.y - 1)); });
  const test::Settings settings = {
      {"mode", "difference"}, {"shape", "sphere"}, {"size", "96"}, {"samples", "256"}};
  const Baked baked = test::bake_preview(
      test::uniform_svbrdf({.diffuse = 0, .f0 = 0.9f, .roughness = 0.7f}), lamp, settings);
  const Plane& red = *baked.artifacts.at(0).image.find("R");
  EXPECT_GT(std::abs(red.at(48, 5)), 4 * std::abs(red.at(48, 48)));
}

TEST(DifferencePreview, OfAConstantEnvironmentIsNoise) {
  const Baked baked = test::bake_preview(test::uniform_svbrdf({.f0 = 0.5f}),
                                         test::constant_latlong(1), {{"mode", "difference"}});
  const Plane& red = *baked.artifacts.at(0).image.find("R");
  EXPECT_NEAR(test::mean(red), 0, 2e-3);
}

}  // namespace
}  // namespace kiln

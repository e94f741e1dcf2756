// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "kiln/parallel/threads.h"
#include "support/scenes.h"

namespace kiln {
namespace {

using test::mean;
using test::preview;
using test::same_planes;
using test::Uniform;
using test::uniform_svbrdf;

bool all_finite(const Layers& image) {
  const Oddities found = count_oddities(image);
  return found.nan == 0 && found.inf == 0 && found.negative == 0;
}

// A lamp of a few degrees in the given direction over a dim surround.
Layers lamp_toward(const Vec3<double>& toward) {
  return test::make_latlong(
      {128, 64}, [=](const Vec3<double>& d) { return dot(d, toward) > 0.97 ? 50.0 : 0.05; });
}

TEST(ReferencePreview, OfAWhiteSurfaceInAWhiteRoomIsWhite) {
  for (const float roughness : {0.1f, 0.5f, 1.0f}) {
    const Uniform white{.size = {32, 32}, .diffuse = 1, .f0 = 0.04f, .roughness = roughness};
    const Layers image =
        preview(uniform_svbrdf(white), test::constant_latlong(1), {{"samples", "256"}}, "lambert");
    EXPECT_NEAR(mean(*image.find("R")), 1, 3e-3) << "roughness " << roughness;
  }
}

TEST(ReferencePreview, OfAWhiteMetalInAWhiteRoomIsWhite) {
  for (const float roughness : {0.05f, 0.4f, 1.0f}) {
    const Uniform metal{.size = {32, 32}, .diffuse = 0, .f0 = 1, .roughness = roughness};
    const Layers image = preview(uniform_svbrdf(metal), test::constant_latlong(1),
                                 {{"samples", "256"}, {"view", "60,0"}});
    EXPECT_NEAR(mean(*image.find("R")), 1, 3e-3) << "roughness " << roughness;
  }
}

TEST(ReferencePreview, NeverReflectsMoreThanItReceives) {
  for (const float f0 : {0.0f, 0.04f, 0.5f}) {
    for (const char* view : {"0,0", "50,0", "80,90"}) {
      const Uniform white{.size = {32, 32}, .diffuse = 1, .f0 = f0, .roughness = 0.4f};
      const Layers image = preview(uniform_svbrdf(white), test::constant_latlong(1),
                                   {{"samples", "256"}, {"view", view}}, "eon");
      EXPECT_LE(mean(*image.find("R")), 1 + 3e-3);
    }
  }
}

// Thumbnails do without the lobes whose light is known, so that they need not be made.
TEST(ReferencePreview, LeavesLittleNoiseWhereItTakesMoreThanAFewDirections) {
  const auto error_of = [](Size size) {
    return mean(*preview(uniform_svbrdf({.size = size}), lamp_toward({0, 0, 1}),
                         {{"samples", "64"}, {"view", "20,0"}})
                     .find("stderr.R"));
  };
  EXPECT_LT(error_of({32, 32}), 0.2 * error_of({32, 31}));
}

TEST(SplitSumPreview, OfAWhiteSurfaceInAWhiteRoomIsWhite) {
  for (const float f0 : {0.04f, 1.0f}) {
    const Uniform white{.diffuse = f0 < 1 ? 1.0f : 0.0f, .f0 = f0, .roughness = 0.6f};
    const Layers image = preview(uniform_svbrdf(white), test::constant_latlong(1),
                                 {{"mode", "split-sum"}}, "lambert");
    EXPECT_NEAR(mean(*image.find("R")), 1, 1e-3);
  }
}

TEST(DifferencePreview, IsSplitSumMinusReference) {
  const Svbrdf material = uniform_svbrdf({});
  const Layers latlong = lamp_toward({0, 0, 1});
  const Layers approximate = preview(material, latlong, {{"mode", "split-sum"}});
  const Layers reference = preview(material, latlong, {{"mode", "reference"}});
  const Layers difference = preview(material, latlong, {{"mode", "difference"}});
  EXPECT_FLOAT_EQ(difference.find("R")->at(3, 4),
                  approximate.find("R")->at(3, 4) - reference.find("R")->at(3, 4));
}

TEST(FlatPreview, BrightensWhereTheNormalLeansTowardTheLight) {
  const auto brightness = [](Vec3<float> normal, const Vec3<double>& light) {
    Uniform texel{.diffuse = 0.8f, .roughness = 0.8f};
    texel.normal = normal;
    return mean(*preview(uniform_svbrdf(texel), lamp_toward(light), {}).find("R"));
  };
  EXPECT_GT(brightness({0.6f, 0, 0.8f}, {1, 0, 0}), 3 * brightness({-0.6f, 0, 0.8f}, {1, 0, 0}));
  EXPECT_GT(brightness({0, 0.6f, 0.8f}, {0, 1, 0}), 3 * brightness({0, -0.6f, 0.8f}, {0, 1, 0}));
}

// Mean of a block of the ball around a point given as shares of the picture.
double block(const Layers& image, double cx, double cy) {
  double sum = 0;
  const int x0 = static_cast<int>(cx * image.size.width) - 3;
  const int y0 = static_cast<int>(cy * image.size.height) - 3;
  for (int y = y0; y < y0 + 6; ++y) {
    for (int x = x0; x < x0 + 6; ++x) sum += image.find("R")->at(x, y);
  }
  return sum / 36;
}

TEST(BallPreview, IsLitFromTheSideWhereTheLightIs) {
  const Svbrdf material = uniform_svbrdf({.diffuse = 0.8f, .roughness = 0.9f});
  const test::Settings ball = {{"shape", "sphere"}, {"size", "64"}};
  const Layers right = preview(material, lamp_toward({1, 0, 0}), ball);
  EXPECT_GT(block(right, 0.8, 0.5), 5 * block(right, 0.2, 0.5));
  const Layers above = preview(material, lamp_toward({0, 1, 0}), ball);
  EXPECT_GT(block(above, 0.5, 0.2), 5 * block(above, 0.5, 0.8));
}

TEST(BallPreview, OfAMirrorShowsWhatIsBehindTheViewerInItsMiddle) {
  const Svbrdf mirror = uniform_svbrdf({.diffuse = 0, .f0 = 1, .roughness = 0.05f});
  const Layers image =
      preview(mirror, lamp_toward({0, 0, 1}), {{"shape", "sphere"}, {"size", "64"}});
  EXPECT_GT(block(image, 0.5, 0.5), 10);
  EXPECT_LT(block(image, 0.25, 0.5), 1);
}

TEST(BallPreview, RotationTurnsPlusZTowardPlusX) {
  const Svbrdf material = uniform_svbrdf({.diffuse = 0.8f, .roughness = 0.9f});
  const Layers image = preview(material, lamp_toward({0, 0, 1}),
                               {{"shape", "sphere"}, {"size", "64"}, {"rotate", "90"}});
  EXPECT_GT(block(image, 0.8, 0.5), 5 * block(image, 0.2, 0.5));
}

TEST(BallPreview, HasATransparentBackgroundAndASmoothEdge) {
  const Layers image = preview(uniform_svbrdf({}), test::constant_latlong(1),
                               {{"shape", "sphere"}, {"size", "64"}, {"samples", "64"}});
  const Plane& alpha = *image.find("A");
  EXPECT_EQ(alpha.at(0, 0), 0);
  EXPECT_EQ(image.find("R")->at(0, 0), 0);
  EXPECT_EQ(alpha.at(32, 32), 1);
  int partial = 0;
  for (int y = 0; y < 64; ++y) {
    for (const float a : alpha.texels_of_row(y)) partial += a > 0 && a < 1;
  }
  EXPECT_GT(partial, 100);
  EXPECT_NEAR(mean(alpha), pi * 0.48 * 0.48, 2e-3);
}

TEST(BallPreview, HasNoDarkRim) {
  const Uniform white{.diffuse = 1, .f0 = 0.04f, .roughness = 0.5f};
  const Layers image =
      preview(uniform_svbrdf(white), test::constant_latlong(1),
              {{"shape", "sphere"}, {"size", "64"}, {"samples", "512"}}, "lambert");
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      if (image.find("A")->at(x, y) > 0) {
        EXPECT_GT(image.find("R")->at(x, y), 0.85) << x << "," << y;
      }
    }
  }
}

TEST(Previews, OfNormalsThatTurnAwayFromTheViewerAreNeitherBlackNorNaN) {
  Uniform texel{.diffuse = 1, .f0 = 0.04f, .roughness = 0.5f};
  texel.normal = {-0.99f, 0, 0.141f};
  for (const char* mode : {"reference", "split-sum"}) {
    const Layers image = preview(uniform_svbrdf(texel), test::constant_latlong(1),
                                 {{"view", "80,0"}, {"mode", mode}, {"samples", "256"}}, "lambert");
    EXPECT_TRUE(all_finite(image));
    EXPECT_NEAR(mean(*image.find("R")), 1, 2e-2) << mode;
  }
}

TEST(Previews, AreFiniteForEveryExtremeMaterial) {
  for (const float roughness : {0.0f, 1.0f}) {
    for (const float f0 : {0.0f, 1.0f}) {
      for (const char* view : {"0,0", "89.9,0"}) {
        for (const char* mode : {"reference", "split-sum"}) {
          const Uniform texel{.diffuse = 1, .f0 = f0, .roughness = roughness};
          const Layers image = preview(uniform_svbrdf(texel), lamp_toward({0.6, 0, 0.8}),
                                       {{"view", view}, {"mode", mode}});
          EXPECT_TRUE(all_finite(image)) << roughness << " " << f0 << " " << view << " " << mode;
        }
      }
    }
  }
}

TEST(Previews, OcclusionDimsTheDiffuseLobeOnly) {
  const Layers room = test::constant_latlong(1);
  const auto brightness = [&](float diffuse, float occlusion) {
    const Uniform texel{.diffuse = diffuse, .f0 = 0.5f, .roughness = 0.5f, .occlusion = occlusion};
    return mean(*preview(uniform_svbrdf(texel), room, {{"mode", "split-sum"}}).find("R"));
  };
  EXPECT_FLOAT_EQ(brightness(0, 0.2f), brightness(0, 1));
  EXPECT_NEAR(brightness(0.8f, 0), brightness(0, 1), 1e-6);
}

TEST(Previews, AreTheSameBytesForAnyNumberOfThreadsAndEveryRun) {
  const Svbrdf material = uniform_svbrdf({.size = {40, 24}});
  const Layers latlong = lamp_toward({0.6, 0, 0.8});
  for (const char* shape : {"flat", "sphere"}) {
    for (const char* mode : {"reference", "split-sum"}) {
      const auto run = [&](int threads) {
        const ThreadLimit limit(threads);
        return preview(material, latlong, {{"shape", shape}, {"mode", mode}});
      };
      const Layers one = run(1);
      EXPECT_TRUE(same_planes(one, run(4))) << shape << " " << mode;
      EXPECT_TRUE(same_planes(one, run(1))) << shape << " " << mode;
    }
  }
}

TEST(Previews, SampleUntilTheErrorAskedForIsReached) {
  const Layers image = preview(uniform_svbrdf({}), lamp_toward({0, 0, 1}),
                               {{"samples", "16"}, {"target_error", "0.02"}});
  EXPECT_LE(mean(*image.find("stderr.R")), 0.02);
}

TEST(Previews, RefuseAViewFromBelow) {
  EXPECT_THROW(preview(uniform_svbrdf({}), test::constant_latlong(1), {{"view", "95,0"}}), Error);
  EXPECT_THROW(preview(uniform_svbrdf({}), test::constant_latlong(1), {{"view", "up"}}), Error);
}

}  // namespace
}  // namespace kiln

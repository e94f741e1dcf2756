// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <map>
#include <set>

#include "kiln/parallel/threads.h"
#include "support/scenes.h"

namespace kiln {
namespace {

Layers small_lamp() {
  return test::make_latlong({128, 64}, [](const Vec3<double>& d) {
    return dot(d, {0, 0.6, 0.8}) > 0.98 ? 80.0 : 0.1;
  });
}

constexpr double target_error = 0.001;

// Smooth on the left, matt and dark on the right; no multiple of a block wide or high.
Svbrdf two_halves() {
  Svbrdf s = test::uniform_svbrdf({.size = {72, 40}});
  for (int y = 0; y < 40; ++y) {
    for (int x = 0; x < 72; ++x) {
      const bool left = x < 32;
      s.roughness.at(x, y) = left ? 0.3f : 1.0f;
      for (int c = 0; c < 3; ++c) {
        s.f0[c].at(x, y) = left ? 0.9f : 0.0f;
        s.diffuse_color[c].at(x, y) = left ? 0.0f : 0.02f;
      }
    }
  }
  return s;
}

double mean_error(const Layers& image, int x0, int y0) {
  double sum = 0, count = 0;
  for (int y = y0; y < std::min(y0 + 16, image.size.height); ++y) {
    for (int x = x0; x < std::min(x0 + 16, image.size.width); ++x) {
      if (image.find("A")->at(x, y) <= 0) continue;
      for (const char* name : {"stderr.R", "stderr.G", "stderr.B"}) {
        sum += image.find(name)->at(x, y) / 3;
      }
      ++count;
    }
  }
  return count > 0 ? sum / count : 0;
}

// The different numbers of samples of the pixels shown in a block.
std::set<float> counts_of(const Layers& image, int x0, int y0) {
  std::set<float> found;
  for (int y = y0; y < std::min(y0 + 16, image.size.height); ++y) {
    for (int x = x0; x < std::min(x0 + 16, image.size.width); ++x) {
      if (image.find("A")->at(x, y) > 0) found.insert(image.find("samples.count")->at(x, y));
    }
  }
  return found;
}

// Tests that look at the same picture share it.
const Baked& refined(const std::string& shape) {
  static std::map<std::string, Baked> made;
  const auto [found, fresh] = made.try_emplace(shape);
  if (fresh) {
    found->second = test::bake_preview(
        two_halves(), small_lamp(),
        {{"shape", shape}, {"size", "72x40"}, {"target_error", std::to_string(target_error)}});
  }
  return found->second;
}

TEST(TargetError, IsReachedInEveryBlockByItsOwnNumberOfSamples) {
  for (const char* shape : {"flat", "sphere"}) {
    const Layers& image = refined(shape).artifacts.at(0).image;
    std::set<float> different;
    for (int y = 0; y < 40; y += 16) {
      for (int x = 0; x < 72; x += 16) {
        EXPECT_LE(mean_error(image, x, y), target_error);
        const std::set<float> found = counts_of(image, x, y);
        EXPECT_LE(found.size(), 1u);
        different.insert(found.begin(), found.end());
      }
    }
    EXPECT_GE(different.size(), 2u) << shape;
    EXPECT_GE(*different.begin(), 64);
  }
}

TEST(TargetError, StopsAtTheFirstDoublingThatReachesIt) {
  const test::Settings once = {{"samples", "16"}}, easy = {{"target_error", "1e9"}};
  const Layers image = test::preview(two_halves(), small_lamp(), easy);
  EXPECT_EQ(test::mean(*image.find("samples.count")), 64);
  EXPECT_EQ(test::preview(two_halves(), small_lamp(), once).find("samples.count"), nullptr);
}

std::pair<float, float> extremes(const Plane& plane) {
  std::pair<float, float> found{plane.at(0, 0), plane.at(0, 0)};
  for (int y = 0; y < plane.height(); ++y) {
    for (const float v : plane.texels_of_row(y)) {
      found = {std::min(found.first, v), std::max(found.second, v)};
    }
  }
  return found;
}

TEST(TargetError, GivesTheSameBytesForAnyNumberOfThreads) {
  for (const auto& [bsdf, error] : {std::pair{"opaque", "0.004"}, {"glass", "0.12"}}) {
    SurfaceChoice surface;
    surface.bsdf = bsdf;
    const auto run = [&](int threads) {
      const ThreadLimit limit(threads);
      return test::bake_preview(two_halves(), small_lamp(),
                                {{"samples", "16"}, {"target_error", error}}, surface)
          .artifacts.at(0)
          .image;
    };
    const Layers one = run(1), four = run(4);
    ASSERT_EQ(one.layers.size(), four.layers.size());
    const auto [least, most] = extremes(*one.find("samples.count"));
    EXPECT_LT(least, most) << bsdf;  // some blocks went on
    for (size_t l = 0; l < one.layers.size(); ++l) {
      for (int y = 0; y < 40; ++y) {
        for (int x = 0; x < 72; ++x) {
          ASSERT_EQ(one.layers[l].plane.at(x, y), four.layers[l].plane.at(x, y)) << bsdf;
        }
      }
    }
  }
}

TEST(TargetError, ThatIsOutOfReachIsToldAndNotPretended) {
  const Baked baked = test::bake_preview(test::uniform_svbrdf({.size = {4, 3}}), small_lamp(),
                                         {{"target_error", "1e-9"}});
  ASSERT_EQ(baked.notes.size(), 1u);
  EXPECT_NE(baked.notes[0].find("100 % of the pixels"), std::string::npos) << baked.notes[0];
  EXPECT_EQ(baked.figures.at(1).first, "most samples");
  EXPECT_EQ(baked.figures.at(1).second, 16384);
}

TEST(TargetError, CountsTheSamplesOnTheMean) {
  const Baked& baked = refined("flat");
  const Plane& counts = *baked.artifacts.at(0).image.find("samples.count");
  EXPECT_EQ(baked.figures.at(0).first, "samples");
  EXPECT_NEAR(baked.figures.at(0).second, test::mean(counts), 1e-6);
  EXPECT_LT(baked.figures.at(0).second, 0.8 * baked.figures.at(1).second);
}

}  // namespace
}  // namespace kiln

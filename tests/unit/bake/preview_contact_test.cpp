// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "kiln/core/error.h"
#include "kiln/parallel/threads.h"
#include "sheet.h"
#include "support/scenes.h"

namespace kiln {
namespace {

// Everything different in every direction and in every quarter of the maps.
Svbrdf patches() {
  Svbrdf s = test::uniform_svbrdf({.size = {32, 32}});
  for (int y = 0; y < 32; ++y) {
    for (int x = 0; x < 32; ++x) {
      s.roughness.at(x, y) = x < 16 ? 0.25f : 0.75f;
      s.diffuse_color[0].at(x, y) = y < 16 ? 0.8f : 0.2f;
    }
  }
  return s;
}

Layers uneven_sky() {
  return test::make_latlong({64, 32}, [](const Vec3<double>& d) { return 1 + d.x + 0.5 * d.y; });
}

Layers sheet_of(test::Settings settings = {}) {
  settings.insert(settings.end(), {{"shape", "contact"}, {"size", "48"}, {"samples", "16"}});
  return test::preview(patches(), uneven_sky(), settings);
}

// Where a picture lies in a sheet: the first place where it equals it, texel for texel.
std::optional<Corner> find(const Layers& picture, const Layers& sheet) {
  const auto fits = [&](int x0, int y0) {
    for (int y = 0; y < picture.size.height; ++y) {
      for (int x = 0; x < picture.size.width; ++x) {
        if (picture.find("A")->at(x, y) < 1) continue;
        if (picture.find("R")->at(x, y) != sheet.find("R")->at(x0 + x, y0 + y)) return false;
      }
    }
    return true;
  };
  for (int y = 0; y + picture.size.height <= sheet.size.height; ++y) {
    for (int x = 0; x + picture.size.width <= sheet.size.width; ++x) {
      if (fits(x, y)) return Corner{x, y};
    }
  }
  return std::nullopt;
}

TEST(ContactSheet, HoldsTheBallAndThePlaneUnderThreeRotations) {
  const Layers sheet = sheet_of();
  int last_y = -1;
  for (const char* shape : {"sphere", "flat"}) {
    int last_x = -1, y = -1;
    for (const char* turn : {"0", "120", "240"}) {
      const Layers picture = test::preview(patches(), uneven_sky(),
                                           {{"shape", shape},
                                            {"rotate", turn},
                                            {"view", "45,-90"},
                                            {"size", "48"},
                                            {"samples", "16"}});
      const std::optional<Corner> at = find(picture, sheet);
      ASSERT_TRUE(at) << shape << " " << turn;
      EXPECT_GT(at->x, last_x);
      last_x = at->x;
      y = at->y;
    }
    EXPECT_GT(y, last_y);
    last_y = y;
  }
}

TEST(ContactSheet, IsSceneLinearOpaqueAndFinite) {
  const Layers sheet = sheet_of();
  EXPECT_EQ(sheet.layers.size(), 4u);
  EXPECT_EQ(test::mean(*sheet.find("A")), 1);
  const Oddities odd = count_oddities(sheet);
  EXPECT_EQ(odd.nan + odd.inf + odd.negative, 0);
}

TEST(ContactSheet, ShowsMapsOfNumbersByTheirNumbers) {
  const Layers sheet = sheet_of();
  int quarter = 0, three = 0;
  for (int y = 0; y < sheet.size.height; ++y) {
    for (int x = 0; x < sheet.size.width; ++x) {
      const auto at = [&](const char* c) { return to_srgb(sheet.find(c)->at(x, y)); };
      if (at("R") != at("G") || at("R") != at("B")) continue;
      quarter += std::abs(at("R") - 0.25f) < 1e-4f;
      three += std::abs(at("R") - 0.75f) < 1e-4f;
    }
  }
  EXPECT_GT(quarter, 200);
  EXPECT_GT(three, 200);
}

TEST(ContactSheet, OfDifferencesHasOneScaleForAllPictures) {
  SurfaceChoice surface;
  const Baked baked =
      test::bake_preview(patches(), uneven_sky(),
                         {{"shape", "contact"}, {"size", "48"}, {"mode", "difference"}}, surface);
  const Artifact& made = baked.artifacts.at(0);
  EXPECT_GT(count_oddities(made.image).negative, 0);
  ASSERT_TRUE(made.view.has_value());
  EXPECT_EQ(made.view->size, made.image.size);
  EXPECT_EQ(count_oddities(*made.view).negative, 0);
}

TEST(ContactSheet, IsTheSameBytesForAnyNumberOfThreads) {
  const auto run = [](int threads) {
    const ThreadLimit limit(threads);
    return sheet_of({{"mode", "split-sum"}});
  };
  const Layers one = run(1), four = run(4);
  for (size_t l = 0; l < 4; ++l) {
    for (int y = 0; y < one.size.height; ++y) {
      for (int x = 0; x < one.size.width; ++x) {
        ASSERT_EQ(one.layers[l].plane.at(x, y), four.layers[l].plane.at(x, y));
      }
    }
  }
}

TEST(ContactSheet, TakesTheSizeOfItsPicturesAndRefusesGiants) {
  EXPECT_GT(sheet_of().size.width, 3 * 48);
  EXPECT_LT(sheet_of().size.width, 4 * 48);
  EXPECT_THROW(test::preview(patches(), uneven_sky(), {{"shape", "contact"}, {"size", "5000"}}),
               Error);
}

}  // namespace
}  // namespace kiln

// SPDX-License-Identifier: Apache-2.0
#include "kiln/material/svbrdf.h"

#include <gtest/gtest.h>

#include <cmath>

namespace kiln {
namespace {

Svbrdf flat(Size size) {
  Svbrdf svbrdf;
  svbrdf.name = "flat";
  svbrdf.size = size;
  svbrdf.diffuse_color = {Plane(size, 0.2f), Plane(size, 0.4f), Plane(size, 0.6f)};
  svbrdf.f0 = {Plane(size, 0.04f), Plane(size, 0.05f), Plane(size, 0.06f)};
  svbrdf.roughness = Plane(size, 0.3f);
  svbrdf.normal = {Plane(size, 0.0f), Plane(size, 0.0f), Plane(size, 1.0f)};
  svbrdf.ambient_occlusion = Plane(size, 0.9f);
  return svbrdf;
}

void set_normal(Svbrdf& svbrdf, int x, int y, float slope_x, float slope_y) {
  const float nz = 1 / std::sqrt(slope_x * slope_x + slope_y * slope_y + 1);
  svbrdf.normal[0].at(x, y) = slope_x * nz;
  svbrdf.normal[1].at(x, y) = slope_y * nz;
  svbrdf.normal[2].at(x, y) = nz;
}

TEST(Halving, LeavesAConstantMaterialAsItIs) {
  const Svbrdf half = halve(flat({7, 5}));
  EXPECT_EQ(half.size, (Size{4, 3}));
  EXPECT_EQ(half.name, "flat");
  for (int y = 0; y < 3; ++y) {
    for (int x = 0; x < 4; ++x) {
      EXPECT_NEAR(half.diffuse_color[1].at(x, y), 0.4f, 1e-6);
      EXPECT_NEAR(half.f0[2].at(x, y), 0.06f, 1e-7);
      EXPECT_NEAR(half.roughness.at(x, y), 0.3f, 1e-6);
      EXPECT_NEAR(half.normal[2].at(x, y), 1, 1e-6);
      EXPECT_NEAR(half.ambient_occlusion.at(x, y), 0.9f, 1e-6);
    }
  }
}

TEST(Halving, AveragesSquaredAlphaNotRoughness) {
  Svbrdf svbrdf = flat({2, 1});
  svbrdf.roughness.at(0, 0) = 0.0f;
  svbrdf.roughness.at(1, 0) = 1.0f;
  EXPECT_NEAR(halve(svbrdf).roughness.at(0, 0), std::pow(0.5, 0.25), 1e-6);
}

TEST(Halving, AveragesColoursLinearly) {
  Svbrdf svbrdf = flat({2, 2});
  svbrdf.diffuse_color[0].at(0, 0) = 1.0f;
  EXPECT_NEAR(halve(svbrdf).diffuse_color[0].at(0, 0), (1 + 3 * 0.2f) / 4, 1e-6);
}

TEST(Halving, AveragesNormalsAsSlopes) {
  Svbrdf svbrdf = flat({2, 1});
  set_normal(svbrdf, 0, 0, 3.0f, 0.5f);
  set_normal(svbrdf, 1, 0, 0.0f, -0.5f);
  const Svbrdf half = halve(svbrdf);
  EXPECT_NEAR(half.normal[0].at(0, 0) / half.normal[2].at(0, 0), 1.5, 1e-5);
  EXPECT_NEAR(half.normal[1].at(0, 0), 0, 1e-6);
}

TEST(Halving, KeepsNormalsUnitAndAboveTheSurface) {
  Svbrdf svbrdf = flat({9, 9});
  for (int y = 0; y < 9; ++y) {
    for (int x = 0; x < 9; ++x) {
      set_normal(svbrdf, x, y, std::sin(static_cast<float>(3 * x + y)) * 30, std::cos(1.7f * y));
    }
  }
  for (const Svbrdf& level : mip_chain(svbrdf)) {
    for (int y = 0; y < level.size.height; ++y) {
      for (int x = 0; x < level.size.width; ++x) {
        const float nx = level.normal[0].at(x, y), ny = level.normal[1].at(x, y),
                    nz = level.normal[2].at(x, y);
        EXPECT_NEAR(nx * nx + ny * ny + nz * nz, 1, 1e-5);
        EXPECT_GT(nz, 0);
      }
    }
  }
}

TEST(MipChain, GoesDownToOneTexelAndHalvesEveryStep) {
  const auto chain = mip_chain(flat({12, 5}));
  ASSERT_EQ(chain.size(), 5u);
  EXPECT_EQ(chain[0].size, (Size{12, 5}));
  EXPECT_EQ(chain[1].size, (Size{6, 3}));
  EXPECT_EQ(chain[2].size, (Size{3, 2}));
  EXPECT_EQ(chain[3].size, (Size{2, 1}));
  EXPECT_EQ(chain[4].size, (Size{1, 1}));
}

TEST(MipChain, OfOneTexelIsItself) { EXPECT_EQ(mip_chain(flat({1, 1})).size(), 1u); }

TEST(MipChain, KeepsTheMeanColourOfPowersOfTwo) {
  Svbrdf svbrdf = flat({16, 8});
  double mean = 0;
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 16; ++x) {
      svbrdf.f0[0].at(x, y) = static_cast<float>((x * 7 + y * 13) % 17) / 17;
      mean += svbrdf.f0[0].at(x, y) / (16.0 * 8.0);
    }
  }
  EXPECT_NEAR(mip_chain(svbrdf).back().f0[0].at(0, 0), mean, 1e-6);
}

}  // namespace
}  // namespace kiln

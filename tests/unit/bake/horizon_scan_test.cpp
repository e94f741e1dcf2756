// SPDX-License-Identifier: Apache-2.0
#include "horizon_scan.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

namespace kiln {
namespace {

constexpr double pi = std::numbers::pi;

Plane relief(Size size, const std::function<double(int x, int y)>& height) {
  Plane plane(size);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) plane.at(x, y) = static_cast<float>(height(x, y));
  }
  return plane;
}

float visibility_at(const HorizonScan& scan, int x, int y) {
  Plane row({scan.size().width, 1});
  scan.visibility(y, row.row(0));
  return row.at(x, 0);
}

TEST(HorizonScan, SeesAllOfTheSkyFromAPlane) {
  const HorizonScan scan(relief({33, 20}, [](int, int) { return 0.7; }), {8, 15, 16});
  for (int y = 0; y < 20; ++y) {
    for (int x = 0; x < 33; ++x) EXPECT_NEAR(visibility_at(scan, x, y), 1, 1e-6);
  }
}

// Before a wall of height H at distance d that runs along y, a level surface loses
// 1/(2 pi) int sin^2 h over the half circle of azimuths toward it, tan h = H cos(azimuth) / d.
TEST(HorizonScan, LosesWhatAWallHides) {
  constexpr int width = 256, wall = 128;
  constexpr double tall = 20;
  const Plane plane =
      relief({width, 128}, [](int x, int) { return x >= wall && x < wall + 64 ? 1.0 : 0.0; });
  const HorizonScan scan(plane, {tall, 120, 128});
  for (const int distance : {4, 8, 15}) {
    double hidden = 0;
    constexpr int steps = 10000;
    for (int i = 0; i < steps; ++i) {
      const double azimuth = pi * ((i + 0.5) / steps - 0.5);
      const double slope = tall * std::cos(azimuth) / distance;
      hidden += slope * slope / (1 + slope * slope) / steps * 0.5;
    }
    EXPECT_NEAR(visibility_at(scan, wall - distance, 64), 1 - hidden, 0.02) << distance;
  }
}

TEST(HorizonScan, RollsWithItsMap) {
  const auto height = [](int x, int y) {
    return 0.5 + 0.5 * std::sin(0.4 * x) * std::cos(0.3 * y);
  };
  const Size size{45, 64};
  const HorizonScan plain(relief(size, height), {6, 20, 8});
  const HorizonScan rolled(
      relief(size,
             [&](int x, int y) { return height((x + 11) % size.width, (y + 5) % size.height); }),
      {6, 20, 8});
  for (int y = 0; y < size.height; y += 7) {
    for (int x = 0; x < size.width; ++x) {
      EXPECT_EQ(visibility_at(rolled, x, y),
                visibility_at(plain, (x + 11) % size.width, (y + 5) % size.height));
    }
  }
}

}  // namespace
}  // namespace kiln

// SPDX-License-Identifier: Apache-2.0
#include "kiln/integrate/sobol.h"

#include <gtest/gtest.h>

#include <set>

#include "kiln/math/hash.h"

namespace kiln {
namespace {

float coordinate(const SobolPoints& points, int i, int d, std::uint32_t seed) {
  return unit_float(owen_scramble_reversed<std::uint32_t>(points[i][d], seed));
}

TEST(SobolPoints, FillEveryElementaryIntervalOfOneDimensionOnce) {
  const SobolPoints points = sobol_points_reversed(64);
  for (std::uint32_t seed = 0; seed < 20; ++seed) {
    for (int d = 0; d < 4; ++d) {
      std::set<int> intervals;
      for (int i = 0; i < 64; ++i) {
        intervals.insert(static_cast<int>(64 * coordinate(points, i, d, mix_bits(seed))));
      }
      EXPECT_EQ(intervals.size(), 64u) << "dimension " << d << " seed " << seed;
    }
  }
}

TEST(SobolPoints, FillEveryElementaryRectangleOfTheFirstTwoDimensionsOnce) {
  const SobolPoints points = sobol_points_reversed(64);
  for (int columns = 1; columns <= 64; columns *= 2) {
    const int rows = 64 / columns;
    std::set<int> cells;
    for (int i = 0; i < 64; ++i) {
      const int x = static_cast<int>(static_cast<float>(columns) * coordinate(points, i, 0, 11u));
      const int y = static_cast<int>(static_cast<float>(rows) * coordinate(points, i, 1, 77u));
      cells.insert(y * columns + x);
    }
    EXPECT_EQ(cells.size(), 64u) << columns << " columns";
  }
}

TEST(SobolPoints, AreTheSameWideAndScalar) {
  const SobolPoints points = sobol_points_reversed(9);
  const WideFloat wide =
      unit_float(owen_scramble_reversed<WideUint>(WideUint(points[8][2]), WideUint(123u)));
  EXPECT_EQ(wide.get(0), coordinate(points, 8, 2, 123u));
}

TEST(SobolPoints, NeverReachZeroOrOne) {
  EXPECT_GT(unit_float(0u), 0.0f);
  EXPECT_LT(unit_float(0xffffffffu), 1.0f);
}

}  // namespace
}  // namespace kiln

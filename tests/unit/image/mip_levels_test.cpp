// SPDX-License-Identifier: Apache-2.0
#include "kiln/image/mip_levels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "kiln/image/resample.h"
#include "kiln/math/hash.h"

namespace kiln {
namespace {

Plane noise(Size size, uint32_t seed) {
  Plane plane(size);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const auto texel = static_cast<uint32_t>(y * size.width + x);
      plane.at(x, y) = static_cast<float>(combine_hash(seed, texel) >> 8) / 16777216.0f;
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

FillRow rows_of(const std::vector<Plane>& planes) {
  return [&planes](int y, float* const* channels) {
    for (size_t c = 0; c < planes.size(); ++c) {
      const auto row = planes[c].texels_of_row(y);
      std::copy(row.begin(), row.end(), channels[c]);
    }
  };
}

// All levels, put together from what each band completes.
std::vector<std::vector<Plane>> levels_by_bands(const std::vector<Plane>& planes, int band) {
  const std::vector<Size> sizes = level_sizes(planes.front().size());
  MipCascade cascade(sizes, static_cast<int>(planes.size()));
  std::vector<std::vector<Plane>> levels(sizes.size());
  std::vector<int> rows(sizes.size());
  for (size_t l = 1; l < sizes.size(); ++l) levels[l].assign(planes.size(), Plane(sizes[l]));
  const int height = planes.front().height();
  for (int first = 0; first < height; first += band) {
    for (const LevelRows& made : cascade.add(std::min(band, height - first), rows_of(planes))) {
      EXPECT_EQ(made.first, rows[made.level]);
      rows[made.level] += made.rows();
      for (size_t c = 0; c < planes.size(); ++c) {
        for (int y = 0; y < made.rows(); ++y) {
          const auto row = made.planes[c].texels_of_row(y);
          std::copy(row.begin(), row.end(), levels[made.level][c].row(made.first + y));
        }
      }
    }
  }
  for (size_t l = 1; l < sizes.size(); ++l) EXPECT_EQ(rows[l], sizes[l].height);
  return levels;
}

bool same(const Plane& a, const Plane& b) {
  if (a.size() != b.size()) return false;
  for (int y = 0; y < a.height(); ++y) {
    const auto one = a.texels_of_row(y), other = b.texels_of_row(y);
    if (!std::equal(one.begin(), one.end(), other.begin())) return false;
  }
  return true;
}

constexpr Size odd_sizes[] = {{64, 32}, {61, 33}, {7, 130}, {1, 19}, {23, 1}, {3, 3}, {2, 5}};

TEST(MipLevels, HalveEachAxisRoundedDownUntilOneTexelIsLeft) {
  const std::vector<Size> expected{{13, 4}, {6, 2}, {3, 1}, {1, 1}};
  EXPECT_EQ(level_sizes({13, 4}), expected);
  EXPECT_EQ(level_sizes({13, 4}, 2).size(), 2u);
  EXPECT_EQ(level_sizes({1, 1}).size(), 1u);
}

TEST(MipLevels, AreTheExactAreaAverageOfTheLevelAbove) {
  for (const Size size : odd_sizes) {
    const Plane plane = noise(size, 1);
    const Plane made = next_level(plane), expected = resample(plane, next_level(size));
    for (int y = 0; y < made.height(); ++y) {
      for (int x = 0; x < made.width(); ++x) EXPECT_NEAR(made.at(x, y), expected.at(x, y), 3e-7);
    }
  }
}

TEST(MipLevels, KeepTheMeanAtEverySize) {
  for (const Size size : odd_sizes) {
    const Plane plane = noise(size, 2);
    const auto levels = levels_by_bands({plane}, size.height);
    for (size_t l = 1; l < levels.size(); ++l) EXPECT_NEAR(mean(levels[l][0]), mean(plane), 1e-6);
  }
}

TEST(MipLevels, AreTheSameBitsHoweverTheRowsCome) {
  for (const Size size : odd_sizes) {
    const std::vector<Plane> planes{noise(size, 3), noise(size, 4)};
    const auto whole = levels_by_bands(planes, size.height);
    for (const int band : {1, 2, 3, 8, 13}) {
      const auto levels = levels_by_bands(planes, band);
      for (size_t l = 1; l < levels.size(); ++l) {
        EXPECT_TRUE(same(levels[l][0], whole[l][0]));
        EXPECT_TRUE(same(levels[l][1], whole[l][1]));
      }
    }
  }
}

TEST(MipLevels, OfARolledImageAreRolled) {
  const Size size{64, 48};
  const Plane plane = noise(size, 5);
  Plane rolled(size);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      rolled.at((x + 24) % size.width, (y + 8) % size.height) = plane.at(x, y);
    }
  }
  const auto levels = levels_by_bands({plane}, 16), of_rolled = levels_by_bands({rolled}, 16);
  for (int l = 1; l <= 3; ++l) {
    const Plane& level = levels[l][0];
    for (int y = 0; y < level.height(); ++y) {
      for (int x = 0; x < level.width(); ++x) {
        EXPECT_EQ(
            of_rolled[l][0].at((x + (24 >> l)) % level.width(), (y + (8 >> l)) % level.height()),
            level.at(x, y));
      }
    }
  }
}

}  // namespace
}  // namespace kiln

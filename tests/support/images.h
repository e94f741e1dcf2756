// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "kiln/image/layers.h"

namespace kiln::test {

/// The greatest absolute difference of two images, channel by channel in their order, which must
/// have one size and as many channels.
inline double greatest_difference(const Layers& a, const Layers& b) {
  EXPECT_EQ(a.size, b.size);
  EXPECT_EQ(a.layers.size(), b.layers.size());
  if (a.size != b.size || a.layers.size() != b.layers.size()) return INFINITY;
  double worst = 0;
  for (size_t c = 0; c < a.layers.size(); ++c) {
    for (int y = 0; y < a.size.height; ++y) {
      for (int x = 0; x < a.size.width; ++x) {
        worst = std::max<double>(worst,
                                 std::abs(a.layers[c].plane.at(x, y) - b.layers[c].plane.at(x, y)));
      }
    }
  }
  return worst;
}

}  // namespace kiln::test

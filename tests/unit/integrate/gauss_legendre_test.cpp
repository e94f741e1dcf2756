// SPDX-License-Identifier: Apache-2.0
#include "kiln/integrate/gauss_legendre.h"

#include <gtest/gtest.h>

#include <cmath>

namespace kiln {
namespace {

TEST(GaussLegendre, IsExactForPolynomialsOfTwiceItsOrder) {
  for (int n : {1, 2, 3, 5, 8, 16, 28, 64}) {
    const Rule rule = gauss_legendre(n);
    for (int degree = 0; degree < 2 * n; ++degree) {
      double sum = 0;
      for (int i = 0; i < n; ++i) sum += rule.weights[i] * std::pow(rule.nodes[i], degree);
      EXPECT_NEAR(sum, 1.0 / (degree + 1), 2e-15) << "order " << n << " degree " << degree;
    }
  }
}

TEST(GaussLegendre, NodesAscendAndMirrorEachOther) {
  const Rule rule = gauss_legendre(31);
  for (int i = 0; i < 31; ++i) {
    EXPECT_DOUBLE_EQ(rule.nodes[i] + rule.nodes[30 - i], 1.0);
    if (i > 0) {
      EXPECT_GT(rule.nodes[i], rule.nodes[i - 1]);
    }
  }
}

}  // namespace
}  // namespace kiln

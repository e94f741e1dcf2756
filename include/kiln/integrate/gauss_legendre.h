// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

namespace kiln {

/// Nodes and weights of a quadrature rule.
struct Rule {
  std::vector<double> nodes;
  std::vector<double> weights;
};

/// The n-point Gauss-Legendre rule on [0,1]; exact for polynomials of degree 2n - 1. Nodes ascend
/// and are symmetric: nodes[i] + nodes[n-1-i] = 1.
/// @valid     n >= 1
/// @accuracy  nodes and weights to a few ulp for n up to 500
Rule gauss_legendre(int n);

}  // namespace kiln

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "kiln/table/lobe.h"

namespace kiln {

/// Chebyshev nodes of an axis in the logarithm of its quantity.
struct LogAxis {
  double low = 1, high = 1;  ///< of the quantity
  int count = 2;
  double node(int k) const;  ///< the quantity at node k
  /// Weights of the nodes for a value at x (barycentric form of Lagrange's polynomial).
  std::vector<double> weights(double x) const;
};

/// The terms of a lobe as a polynomial in ln mu and ln alpha.
///
/// Albedos change over scales that are ratios (mu against alpha), so in logarithms they are smooth
/// everywhere and converge geometrically. `scale` is interpolated by its logarithm, which keeps its
/// relative error where it is small.
class SmoothField {
 public:
  using Source = std::function<std::vector<LobeTerms>(double mu, std::span<const double> alphas)>;

  /// @param source  terms at one cosine for several widths
  SmoothField(LogAxis mu, LogAxis alpha, const Source& source);

  /// [alpha][mu]; arguments outside the axes are clamped
  std::vector<LobeTerms> grid(std::span<const double> mus, std::span<const double> alphas) const;

 private:
  LogAxis mu_, alpha_;
  std::array<std::vector<double>, 3> nodes_;  // [alpha][mu]: ln scale, bias, edge
};

}  // namespace kiln

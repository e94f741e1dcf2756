// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "candidates.h"

namespace kiln::validate {

using Terms = SplitSumTerms<double>;

/// Integrals on a grid, and what tables may hold in their stead where an axis ends: they stop short
/// of n.v = 0 by an amount of their own, which is 1e-4 here, and 1e-3 in `grazing`.
struct Grid {
  std::vector<Terms> terms;    ///< [alpha][mu]
  std::vector<Terms> grazing;  ///< [alpha]
};

/// Integrals of one lobe at all pairs of some cosines and alphas, made once for many readings.
class Integrals {
 public:
  Integrals(const Lobe& lobe, std::vector<double> mus, std::vector<double> alphas);

  /// Of averages over directions, 2 INT_0^1 (...) mu dmu, which stand at mu = 1.
  static Integrals averages(const Lobe& lobe, std::vector<double> alphas);

  /// @valid values that the constructor was given
  Grid at(const std::vector<double>& mus, const std::vector<double>& alphas) const;

 private:
  Integrals() = default;
  std::vector<double> mus_, alphas_;
  std::vector<Terms> terms_;
};

/// The terms of a mirror: what some tables hold at alpha = 0, where integrals stop at 1e-4.
Terms mirror_terms(double mu);

}  // namespace kiln::validate

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "candidates.h"

namespace kiln::validate {

using Terms = LobeTerms;

/// Integrals on a grid, and what tables may hold in their stead where an axis ends: they stop short
/// of n.v = 0 by an amount of their own, which is 1e-4 here, and 1e-3 in `grazing`.
struct Grid {
  std::vector<Terms> terms;    ///< [alpha][mu]
  std::vector<Terms> grazing;  ///< [alpha]
};

/// Integrals of a lobe on a grid, to 1e-6.
Grid exact_grid(const Lobe& lobe, const std::vector<double>& mus,
                const std::vector<double>& alphas);

/// Averages over directions, which stand as a grid of one cosine.
Grid exact_averages(const Lobe& lobe, const std::vector<double>& alphas);

/// Integrals of a lobe everywhere, by cubic interpolation: quick, and off by 1e-3 where the lobe is
/// narrow and the direction grazing. Good enough to choose between conventions.
class Field {
 public:
  explicit Field(const Lobe& lobe);

  Grid grid(const std::vector<double>& mus, const std::vector<double>& alphas) const;
  Grid averages(const std::vector<double>& alphas) const;

 private:
  std::vector<Terms> terms_;     // [alpha][mu]
  std::vector<Terms> averages_;  // [alpha]
};

/// The field of a lobe on tried_lobes(); made when first asked for, with those that are as common.
const Field& field_of(int lobe);

/// The terms of a mirror: what some tables hold at alpha = 0, where integrals stop at 1e-4.
Terms mirror_terms(double mu);

}  // namespace kiln::validate

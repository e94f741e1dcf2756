// SPDX-License-Identifier: Apache-2.0
#include "kiln/table/directional_albedo.h"

namespace kiln {

SplitSumTerms<double> integrate_split_sum(double mu, double alpha, Quality quality) {
  const LobeTerms terms = LobeIntegrals({}, {}, quality).at({mu, alpha, alpha, 0});
  return {terms.scale, terms.bias};
}

SplitSumTerms<double> integrate_average(double alpha) {
  const LobeTerms terms = LobeIntegrals({}, {}, Quality::Table).average(alpha);
  return {terms.scale, terms.bias};
}

}  // namespace kiln

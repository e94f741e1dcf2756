// SPDX-License-Identifier: Apache-2.0
#include "kiln/table/lobe.h"

#include "kiln/parallel/rows.h"
#include "kiln/table/directional_albedo.h"

namespace kiln {

std::vector<SplitSumTerms<double>> integrate_grid(const Lobe&, std::span<const double> mus,
                                                  std::span<const double> alphas, Quality quality) {
  std::vector<SplitSumTerms<double>> terms(mus.size() * alphas.size());
  for_rows(static_cast<int>(mus.size()), [&](int i) {
    const QuadratureOrder order =
        quality == Quality::Exact ? reference_order : table_order(mus[i]);
    const ViewRule rule = make_view_rule(mus[i], order.azimuths);
    for (size_t j = 0; j < alphas.size(); ++j) {
      terms[j * mus.size() + i] = integrate_split_sum(rule, alphas[j], order.slopes);
    }
  });
  return terms;
}

}  // namespace kiln

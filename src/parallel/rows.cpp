// SPDX-License-Identifier: Apache-2.0
#include "kiln/parallel/rows.h"

#include <tbb/parallel_for.h>

namespace kiln {

void for_rows(int count, const std::function<void(int)>& row) {
  tbb::parallel_for(0, count, [&](int i) { row(i); });
}

std::vector<double> sum_rows(int count, int width,
                             const std::function<void(int, std::vector<double>&)>& row) {
  std::vector<std::vector<double>> shares(static_cast<size_t>(count));
  for_rows(count, [&](int i) {
    auto& share = shares[static_cast<size_t>(i)];
    share.assign(static_cast<size_t>(width), 0.0);
    row(i, share);
  });
  std::vector<double> total(static_cast<size_t>(width), 0.0);
  for (const auto& share : shares) {
    for (size_t i = 0; i < total.size(); ++i) total[i] += share[i];
  }
  return total;
}

}  // namespace kiln

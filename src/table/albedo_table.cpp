// SPDX-License-Identifier: Apache-2.0
#include "kiln/table/albedo_table.h"

#include "kiln/brdf/roughness.h"
#include "kiln/parallel/rows.h"
#include "kiln/table/directional_albedo.h"

namespace kiln {

AlbedoTable AlbedoTable::build() {
  AlbedoTable table;
  table.entries_.resize(2 * nodes * nodes);
  table.averages_.resize(2 * nodes);
  for_rows(nodes, [&](int j) {
    const double roughness = square(static_cast<double>(j) / (nodes - 1));
    const double alpha = to_alpha(roughness);
    const double bend = std::max(roughness, least_bend);
    float* entry = &table.entries_[static_cast<size_t>(2 * nodes) * j];
    for (int i = 0; i < nodes; ++i) {
      const double u = static_cast<double>(i) / (nodes - 1);
      const auto terms = integrate_split_sum(u * bend / (1 + bend - u), alpha);
      *entry++ = static_cast<float>(terms.scale);
      *entry++ = static_cast<float>(terms.bias);
    }
    const auto average = integrate_average(alpha);
    table.averages_[2 * j] = static_cast<float>(average.scale);
    table.averages_[2 * j + 1] = static_cast<float>(average.bias);
  });
  return table;
}

}  // namespace kiln

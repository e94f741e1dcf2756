// SPDX-License-Identifier: Apache-2.0
#include "kiln/table/albedo_table.h"

#include <algorithm>

#include "kiln/brdf/roughness.h"
#include "kiln/parallel/rows.h"

namespace kiln {

AlbedoTable AlbedoTable::build(const Lobe& lobe) {
  const LobeIntegrals integrals(lobe, {}, Quality::Table);
  AlbedoTable table;
  table.entries_.resize(2 * nodes * nodes);
  table.averages_.resize(2 * nodes);
  table.edges_.resize(nodes * nodes);
  table.edge_averages_.resize(nodes);
  for_rows(nodes, [&](int j) {
    const double roughness = square(static_cast<double>(j) / (nodes - 1));
    const double alpha = to_alpha(roughness);
    const double bend = std::max(roughness, least_bend);
    float* entry = &table.entries_[static_cast<size_t>(2 * nodes) * j];
    float* edge = &table.edges_[static_cast<size_t>(nodes) * j];
    for (int i = 0; i < nodes; ++i) {
      const double u = static_cast<double>(i) / (nodes - 1);
      const LobeTerms terms = integrals.at({u * bend / (1 + bend - u), alpha, alpha, 0});
      *entry++ = static_cast<float>(terms.scale);
      *entry++ = static_cast<float>(terms.bias);
      *edge++ = static_cast<float>(terms.edge);
    }
    const LobeTerms average = integrals.average(alpha);
    table.averages_[2 * j] = static_cast<float>(average.scale);
    table.averages_[2 * j + 1] = static_cast<float>(average.bias);
    table.edge_averages_[j] = static_cast<float>(average.edge);
  });
  for (size_t i = 0; i < table.entries_.size(); i += 2) {
    const double total = table.entries_[i] + table.entries_[i + 1];
    table.greatest_ = std::max(table.greatest_, total);
  }
  return table;
}

}  // namespace kiln

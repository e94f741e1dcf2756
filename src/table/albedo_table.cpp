// SPDX-License-Identifier: Apache-2.0
#include "kiln/table/albedo_table.h"

#include <algorithm>
#include <cmath>

#include "kiln/brdf/roughness.h"
#include "kiln/integrate/gauss_legendre.h"
#include "kiln/parallel/rows.h"

namespace kiln {
namespace {

struct Averages {
  LobeTerms terms;
  double bounded = 0;  // of min(E, 1)
};

// 2 INT_0^1 E(mu) mu dmu with mu = alpha sinh x.
Averages average_lobe(const LobeIntegrals& integrals, double alpha, const Rule& rule) {
  const double reach = std::asinh(1 / alpha);
  Averages sum;
  for (size_t j = 0; j < rule.nodes.size(); ++j) {
    const double x = reach * rule.nodes[j];
    const double mu = alpha * std::sinh(x);
    const double weight = 2 * mu * alpha * std::cosh(x) * reach * rule.weights[j];
    const LobeTerms terms = integrals.at({mu, alpha, alpha, 0});
    sum.terms.scale += weight * terms.scale;
    sum.terms.bias += weight * terms.bias;
    sum.terms.edge += weight * terms.edge;
    sum.bounded += weight * std::min(terms.total(), 1.0);
  }
  return sum;
}

}  // namespace

AlbedoTable AlbedoTable::build(const Lobe& lobe) {
  const LobeIntegrals integrals(lobe, {}, Quality::Table);
  const Rule rule = gauss_legendre(64);
  AlbedoTable table;
  table.entries_.resize(2 * nodes * nodes);
  table.averages_.resize(2 * nodes);
  table.edges_.resize(nodes * nodes);
  table.edge_averages_.resize(nodes);
  table.bounded_averages_.resize(nodes);
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
    const Averages averages = average_lobe(integrals, alpha, rule);
    table.averages_[2 * j] = static_cast<float>(averages.terms.scale);
    table.averages_[2 * j + 1] = static_cast<float>(averages.terms.bias);
    table.edge_averages_[j] = static_cast<float>(averages.terms.edge);
    table.bounded_averages_[j] = static_cast<float>(averages.bounded);
  });
  for (size_t i = 0; i < table.entries_.size(); i += 2) {
    const double total = table.entries_[i] + table.entries_[i + 1];
    table.greatest_ = std::max(table.greatest_, total);
  }
  return table;
}

}  // namespace kiln

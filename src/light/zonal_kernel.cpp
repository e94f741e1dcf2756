// SPDX-License-Identifier: Apache-2.0
#include "zonal_kernel.h"

#include "kiln/integrate/gauss_legendre.h"
#include "lobe.h"

namespace kiln {
namespace {

constexpr int lanes = lane_count<WideDouble>;
constexpr int nodes_per_panel = 16;
constexpr int wides = nodes_per_panel / lanes;

using Panel = std::array<WideDouble, wides>;

/// Nodes in the polar angle with their weights, 16 to a panel.
struct Nodes {
  std::vector<double> theta, weight;
};

// Panels follow both the lobe's width and the waves of the highest band.
Nodes place_nodes(double alpha, int order) {
  const Rule rule = gauss_legendre(nodes_per_panel);
  Nodes nodes;
  for (double from = 0; from < pi / 2;) {
    const double width = std::min(0.3 * (from + 2 * alpha), 10.0 / std::max(order, 1));
    const double to = from + width > pi / 2 - 1e-9 ? pi / 2 : from + width;
    for (size_t i = 0; i < rule.nodes.size(); ++i) {
      nodes.theta.push_back(from + (to - from) * rule.nodes[i]);
      nodes.weight.push_back((to - from) * rule.weights[i]);
    }
    from = to;
  }
  return nodes;
}

Panel load_panel(const double* from) {
  Panel panel;
  for (int i = 0; i < wides; ++i)
    panel[static_cast<size_t>(i)] = load_lanes<WideDouble>(from + i * lanes);
  return panel;
}

// Adds terms[i] P_l(cosine[i]) of one panel to every band, by the recurrence of P_l.
void add_panel(const Panel& cosine, const Panel& terms, std::vector<WideDouble>& bands) {
  Panel current, previous;
  current.fill(WideDouble(1.0));
  previous.fill(WideDouble(0.0));
  for (size_t l = 0; l < bands.size(); ++l) {
    const double n = static_cast<double>(l);
    const WideDouble up((2 * n + 1) / (n + 1)), down(n / (n + 1));
    for (size_t i = 0; i < wides; ++i) {
      bands[l] = fma(terms[i], current[i], bands[l]);
      const WideDouble next = fma(up * cosine[i], current[i], -(down * previous[i]));
      previous[i] = current[i];
      current[i] = next;
    }
  }
}

// 2 pi times the integral of K(cos t) P_l(cos t) sin t.
std::vector<double> integrate_bands(const FilterLobe& lobe, int order) {
  const Nodes nodes = place_nodes(lobe.alpha, order);
  std::vector<double> s, cosine;
  for (const double theta : nodes.theta) {
    s.push_back(square(std::sin(0.5 * theta)));
    cosine.push_back(std::cos(theta));
  }
  std::vector<double> terms = lobe_values(lobe, s);
  for (size_t i = 0; i < terms.size(); ++i) {
    terms[i] *= 2 * pi * nodes.weight[i] * std::sin(nodes.theta[i]);
  }
  std::vector<WideDouble> sums(static_cast<size_t>(order) + 1, WideDouble(0.0));
  for (size_t i = 0; i < terms.size(); i += nodes_per_panel) {
    add_panel(load_panel(cosine.data() + i), load_panel(terms.data() + i), sums);
  }
  std::vector<double> bands;
  bands.reserve(sums.size());
  for (const WideDouble& sum : sums) bands.push_back(xsimd::hadd(sum));
  return bands;
}

size_t bands_above(const std::vector<double>& bands, double cut_off) {
  const auto energy = [&](size_t l) {
    return (2 * static_cast<double>(l) + 1) * bands[l] * bands[l];
  };
  double whole = 0, beyond = 0;
  for (size_t l = 0; l < bands.size(); ++l) whole += energy(l);
  size_t count = bands.size();
  while (count > 1 && beyond + energy(count - 1) <= cut_off * cut_off * whole) {
    beyond += energy(--count);
  }
  return count;
}

}  // namespace

ZonalKernel expand_lobe(const FilterLobe& lobe, double cut_off, int highest_order) {
  // Far beyond any useful band for the lobe, yet short of it for the widest, whose edge at the
  // horizon alone needs more.
  const int generous = std::max(256, static_cast<int>(std::ceil(16 / lobe.alpha)));
  std::vector<double> bands = integrate_bands(lobe, std::min(generous, highest_order));
  const double integral = bands.front();
  bands.resize(bands_above(bands, cut_off));
  for (double& band : bands) band /= integral;
  return {integral, std::move(bands)};
}

}  // namespace kiln

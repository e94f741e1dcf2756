// SPDX-License-Identifier: Apache-2.0
#include "zonal_kernel.h"

#include "kiln/integrate/gauss_legendre.h"

namespace kiln {
namespace {

// Adds 2 pi K(cos t) P_l(cos t) sin t times the weight to every band.
void add_node(double theta, double weight, double alpha2, std::vector<double>& bands) {
  const double c = std::cos(theta), half = std::sin(0.5 * theta);
  const double lobe = 2 * pi * weight * std::sin(theta) * ggx_lobe(half * half, alpha2);
  double previous = 0, current = 1;
  for (size_t l = 0; l < bands.size(); ++l) {
    bands[l] += lobe * current;
    const double n = static_cast<double>(l);
    const double next = ((2 * n + 1) * c * current - n * previous) / (n + 1);
    previous = current;
    current = next;
  }
}

// Panels follow both the lobe's width and the waves of the highest band.
std::vector<double> integrate_bands(double alpha, int order) {
  const Rule rule = gauss_legendre(16);
  std::vector<double> bands(static_cast<size_t>(order) + 1);
  for (double from = 0; from < pi / 2;) {
    const double width = std::min(0.3 * (from + 2 * alpha), 10.0 / std::max(order, 1));
    const double to = from + width > pi / 2 - 1e-9 ? pi / 2 : from + width;
    for (size_t i = 0; i < rule.nodes.size(); ++i) {
      add_node(from + (to - from) * rule.nodes[i], (to - from) * rule.weights[i], alpha * alpha,
               bands);
    }
    from = to;
  }
  return bands;
}

size_t bands_above(const std::vector<double>& bands, double cut_off) {
  const auto energy = [&](size_t l) { return (2.0 * l + 1) * bands[l] * bands[l]; };
  double whole = 0, beyond = 0;
  for (size_t l = 0; l < bands.size(); ++l) whole += energy(l);
  size_t count = bands.size();
  while (count > 1 && beyond + energy(count - 1) <= cut_off * cut_off * whole) {
    beyond += energy(--count);
  }
  return count;
}

}  // namespace

ZonalKernel expand_ggx_lobe(double alpha, double cut_off, int highest_order) {
  // Far beyond any useful band for the lobe, yet short of it for the widest, whose edge at the
  // horizon alone needs more.
  const int generous = std::max(256, static_cast<int>(std::ceil(16 / alpha)));
  std::vector<double> bands = integrate_bands(alpha, std::min(generous, highest_order));
  const double integral = bands.front();
  bands.resize(bands_above(bands, cut_off));
  for (double& band : bands) band /= integral;
  return {alpha, integral, std::move(bands)};
}

}  // namespace kiln

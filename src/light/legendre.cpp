// SPDX-License-Identifier: Apache-2.0
#include "legendre.h"

#include "kiln/parallel/rows.h"

namespace kiln {
namespace {

constexpr int lanes = lane_count<WideDouble>;

WideDouble power(WideDouble base, int exponent) {
  WideDouble result(1.0);
  for (; exponent > 0; exponent /= 2) {
    if (exponent % 2 == 1) result *= base;
    base *= base;
  }
  return result;
}

}  // namespace

RingPairs::RingPairs(int rings_in) : rings(rings_in), count((rings_in + 1) / 2) {
  for (int first = 0; first < count; first += lanes) {
    double sines[lanes], cosines[lanes];
    for (int i = 0; i < lanes; ++i) {
      const int ring = first + i;
      const bool on_equator = ring >= count || !has_south(ring);
      const double theta = pi * (ring + 0.5) / rings;
      sines[i] = on_equator ? 1.0 : std::sin(theta);
      cosines[i] = on_equator ? 0.0 : std::cos(theta);
    }
    sine.push_back(load_lanes<WideDouble>(sines));
    cosine.push_back(load_lanes<WideDouble>(cosines));
  }
}

LegendreColumn::LegendreColumn(int m_in, int order_in) : m(m_in), order(order_in) {
  double product = 0.25 / pi;
  for (int k = 1; k <= m; ++k) product *= (2.0 * k + 1) / (2.0 * k);
  seed_factor = std::sqrt(product);
  scale.assign(static_cast<size_t>(order + 1 - m), 0.0);
  back = scale;
  double before = 0;
  for (int l = m + 1; l <= order; ++l) {
    const double ll = l, mm = m;
    const double a = std::sqrt((4 * ll * ll - 1) / (ll * ll - mm * mm));
    scale[static_cast<size_t>(l - m)] = a;
    back[static_cast<size_t>(l - m)] = a * before;
    before = 1 / a;
  }
}

WideDouble LegendreColumn::seed(WideDouble sine) const {
  return WideDouble(seed_factor) * power(sine, m);
}

bool LegendreColumn::vanishes_at(const RingPairs& rings, int block, size_t bands) const {
  // Sines grow toward the equator: the last lane has the greatest.
  const double sine = rings.sine[static_cast<size_t>(block)].get(lanes - 1);
  return sine * static_cast<double>(bands) < m - 6 * std::cbrt(static_cast<double>(m)) - 2;
}

int LegendreColumn::first_block(const RingPairs& rings) const {
  int block = 0;
  while (block < rings.blocks() - 1 && vanishes_at(rings, block, static_cast<size_t>(order) + 1)) {
    ++block;
  }
  return block;
}

std::vector<LegendreColumn> legendre_columns(int order) {
  std::vector<LegendreColumn> columns(static_cast<size_t>(order) + 1, LegendreColumn(0, 0));
  for_rows(order + 1, [&](int m) { columns[static_cast<size_t>(m)] = LegendreColumn(m, order); });
  return columns;
}

}  // namespace kiln

// SPDX-License-Identifier: Apache-2.0
#include "legendre.h"

namespace kiln {

RingPairs::RingPairs(int rings_in) : rings(rings_in), count((rings_in + 1) / 2) {
  constexpr int lanes = lane_count<WideDouble>;
  blocks = (count + lanes - 1) / lanes;
  sine.assign(static_cast<size_t>(blocks * lanes), 1.0);
  cosine.assign(static_cast<size_t>(blocks * lanes), 0.0);
  for (int i = 0; i < count; ++i) {
    const double theta = pi * (i + 0.5) / rings;
    sine[static_cast<size_t>(i)] = std::sin(theta);
    cosine[static_cast<size_t>(i)] = has_south(i) ? std::cos(theta) : 0.0;
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

WideDouble LegendreColumn::seed(const RingPairs& rings, int block) const {
  constexpr int lanes = lane_count<WideDouble>;
  double values[lanes];
  for (int i = 0; i < lanes; ++i) {
    values[i] = seed_factor * std::pow(rings.sine[static_cast<size_t>(block * lanes + i)], m);
  }
  return load_lanes<WideDouble>(values);
}

int LegendreColumn::first_block(const RingPairs& rings) const {
  const double smallest = (m - 6 * std::cbrt(static_cast<double>(m)) - 2) / std::max(order, 1);
  int pair = 0;
  while (pair < rings.count && rings.sine[static_cast<size_t>(pair)] < smallest) ++pair;
  return pair / lane_count<WideDouble>;
}

}  // namespace kiln

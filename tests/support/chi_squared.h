// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

namespace kiln::test {

/// Probability that a chi-squared variable of that many degrees of freedom exceeds the statistic:
/// the regularised upper incomplete gamma function Q(dof / 2, statistic / 2).
inline double chi_squared_p(double statistic, double dof) {
  const double a = dof / 2, x = statistic / 2;
  const double scale = std::exp(-x + a * std::log(x) - std::lgamma(a));
  if (x < a + 1) {  // series of the lower function
    double term = 1 / a, sum = term;
    for (int n = 1; n < 10000 && term > sum * 1e-15; ++n) sum += term *= x / (a + n);
    return 1 - sum * scale;
  }
  double b = x + 1 - a, c = 1e300, d = 1 / b, h = d;  // Lentz's continued fraction
  for (int n = 1; n < 10000; ++n) {
    const double an = -n * (n - a);
    b += 2;
    d = 1 / std::max(an * d + b, 1e-300);
    c = std::max(b + an / c, 1e-300);
    h *= d * c;
    if (std::abs(d * c - 1) < 1e-15) break;
  }
  return scale * h;
}

struct ChiSquared {
  double p = 1;
  int cells = 0;  ///< after pooling
};

/// Chi-squared test of counts against expected counts; cells are pooled, least expected first,
/// until each expects at least 5.
inline ChiSquared chi_squared(const std::vector<double>& observed,
                              const std::vector<double>& expected) {
  std::vector<size_t> order(expected.size());
  for (size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::sort(order.begin(), order.end(),
            [&](size_t a, size_t b) { return expected[a] < expected[b]; });
  double statistic = 0, pooled_observed = 0, pooled_expected = 0;
  int cells = 0;
  for (const size_t i : order) {
    pooled_observed += observed[i];
    pooled_expected += expected[i];
    if (pooled_expected < 5) continue;
    statistic +=
        (pooled_observed - pooled_expected) * (pooled_observed - pooled_expected) / pooled_expected;
    pooled_observed = pooled_expected = 0;
    ++cells;
  }
  return {chi_squared_p(statistic, cells - 1), cells};
}

/// The significance of one of `tests` tests whose family is to err with probability 0.01 (Sidak).
inline double family_significance(int tests) { return 1 - std::pow(1 - 0.01, 1.0 / tests); }

}  // namespace kiln::test

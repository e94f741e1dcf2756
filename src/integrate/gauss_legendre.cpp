// SPDX-License-Identifier: Apache-2.0
#include "kiln/integrate/gauss_legendre.h"

#include <cmath>

namespace kiln {
namespace {

struct Legendre {
  double value;
  double derivative;
};

Legendre legendre(int n, double x) {
  double previous = 1, current = x;
  for (int k = 2; k <= n; ++k) {
    const double next = ((2 * k - 1) * x * current - (k - 1) * previous) / k;
    previous = current;
    current = next;
  }
  return {current, n * (x * current - previous) / (x * x - 1)};
}

}  // namespace

Rule gauss_legendre(int n) {
  if (n == 1) return {{0.5}, {1.0}};
  Rule rule{std::vector<double>(n), std::vector<double>(n)};
  constexpr double pi = 3.14159265358979323846;
  for (int i = 0; i < (n + 1) / 2; ++i) {
    // Tricomi's guess is good to four digits; Newton doubles them each time.
    double x = std::cos(pi * (i + 0.75) / (n + 0.5));
    for (int step = 0; step < 6; ++step) {
      const Legendre p = legendre(n, x);
      x -= p.value / p.derivative;
    }
    if (2 * i + 1 == n) x = 0;
    const double slope = legendre(n, x).derivative;
    const double weight = 1 / ((1 - x * x) * slope * slope);
    rule.nodes[i] = 0.5 * (1 - x);
    rule.nodes[n - 1 - i] = 0.5 * (1 + x);
    rule.weights[i] = rule.weights[n - 1 - i] = weight;
  }
  return rule;
}

}  // namespace kiln

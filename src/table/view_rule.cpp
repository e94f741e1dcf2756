// SPDX-License-Identifier: Apache-2.0
#include "kiln/table/view_rule.h"

#include <algorithm>
#include <cmath>

#include "kiln/math/wide.h"

namespace kiln {

ViewRule make_view_rule(double mu, int azimuths) {
  constexpr int lanes = lane_count<WideDouble>;
  ViewRule rule;
  rule.mu = std::clamp(mu, least_mu, 1.0);
  // Straight down every azimuth is alike; a tiny slope keeps the quotients below defined.
  rule.tau = std::max(std::sqrt((1 - rule.mu) * (1 + rule.mu)) / rule.mu, 1e-8);
  rule.sine = rule.tau * rule.mu;
  const int padded = (azimuths + lanes - 1) / lanes * lanes;
  rule.cos_p.assign(padded, 0.0);
  rule.sin_p.assign(padded, 1.0);
  rule.t_max.assign(padded, 1.0);
  rule.weight.assign(padded, 0.0);
  const double reach = std::asinh(rule.tau);
  for (int k = 0; k < azimuths; ++k) {
    const double psi = pi * (k + 0.5) / azimuths;
    const double s = reach * std::cos(psi);
    // tau sin p = sqrt(sinh(S - s) sinh(S + s)), with S -+ s free of cancellation.
    const double below = 2 * reach * square(std::sin(psi / 2));
    const double above = 2 * reach * square(std::cos(psi / 2));
    const double tau_sin_p = std::sqrt(std::sinh(below) * std::sinh(above));
    const double dp_dpsi = reach * std::sin(psi) * std::cosh(s) / tau_sin_p;
    rule.cos_p[k] = std::sinh(s) / rule.tau;
    rule.sin_p[k] = tau_sin_p / rule.tau;
    rule.t_max[k] = std::exp(s);
    rule.weight[k] = 2 * pi / azimuths * dp_dpsi;  // both half circles
  }
  return rule;
}

}  // namespace kiln

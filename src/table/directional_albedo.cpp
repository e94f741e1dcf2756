// SPDX-License-Identifier: Apache-2.0
#include "kiln/table/directional_albedo.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "kiln/brdf/ggx.h"
#include "kiln/brdf/smith.h"
#include "kiln/integrate/gauss_legendre.h"

namespace kiln {
namespace {

using Wide = WideDouble;
constexpr int lanes = lane_count<Wide>;
constexpr double least_mu = 1e-4;

// Rules are tiny and asked for again and again: made once for every order up to the largest.
const Rule& unit_rule(int n) {
  constexpr int largest = reference_order.slopes;
  static const std::array<Rule, largest + 1> rules = [] {
    std::array<Rule, largest + 1> made;
    for (int k = 1; k <= largest; ++k) made[k] = gauss_legendre(k);
    return made;
  }();
  return rules[n];
}

struct Sums {
  Wide scale = Wide(0.0), bias = Wide(0.0);
};

// What the integrand needs of the view direction, lane for lane of azimuths.
struct View {
  Wide mu, sine, tau_cos_p, cos_p, t_max, inverse_t_max;
  Wide stretched;  // |stretched wo|
};

// Adds weight * P22(t) t (1 + t tau cos p) G2 {1 - Fc, Fc} dt/dx at the slope t.
//
// With wi found from the slope, n.wi = mu (tmax - t)(t + 1/tmax) / (1 + t^2), which keeps its
// digits next to the horizon, and G2 = 2 / (1 / a_o + 1 / a_i), a = mu / |stretched w|. The
// half-vector cosine is c = (mu + sine t cos p) / sqrt(1 + t^2).
void add_slope(const View& view, const Ggx<Wide>& ggx, Wide t, Wide weight, Sums& sums) {
  const Wide alpha = ggx.alpha_x;
  const Wide inverse = Wide(1.0) / fma(t, t, Wide(1.0));
  const Wide mu_i = view.mu * (view.t_max - t) * (t + view.inverse_t_max) * inverse;
  const Wide mu_i2 = mu_i * mu_i;
  const Wide stretched_i = sqrt(fma(alpha * alpha, Wide(1.0) - mu_i2, mu_i2));
  const Wide g2 = Wide(2.0) * view.mu * mu_i / fma(view.stretched, mu_i, view.mu * stretched_i);
  const Wide cosine = fma(view.sine * t, view.cos_p, view.mu) * sqrt(inverse);
  const Wide fc = Schlick<Wide>::grazing_weight(cosine);
  const Wide lobe =
      weight * ggx.P22(square(t / alpha)) * t * fma(t, view.tau_cos_p, Wide(1.0)) * g2;
  sums.bias = fma(lobe, fc, sums.bias);
  sums.scale = fma(lobe, Wide(1.0) - fc, sums.scale);
}

// The inner integral for one vector of azimuths. With t = alpha sinh x all scales between alpha and
// tmax are equal. The Gauss nodes come in pairs xi, 1 - xi, and e^((1 - xi) X) = e^X / e^(xi X), so
// one exponential serves two nodes.
Sums integrate_slopes(const View& view, const Ggx<Wide>& ggx, const Rule& rule) {
  const Wide alpha = ggx.alpha_x;
  const Wide reach = view.t_max / alpha;
  const Wide e_x = reach + sqrt(fma(reach, reach, Wide(1.0)));
  const Wide inverse_e_x = Wide(1.0) / e_x;
  const Wide x_max = log(e_x);
  const Wide half = Wide(0.5) * alpha;
  Sums sums;
  const auto add = [&](Wide p, Wide inverse_p, double weight) {
    const Wide dt = half * (p + inverse_p) * x_max * Wide(weight);
    add_slope(view, ggx, half * (p - inverse_p), dt, sums);
  };
  const int n = static_cast<int>(rule.nodes.size());
  for (int j = 0; j < n / 2; ++j) {
    const Wide p = exp(x_max * Wide(rule.nodes[j]));
    const Wide inverse_p = Wide(1.0) / p;
    add(p, inverse_p, rule.weights[j]);
    add(e_x * inverse_p, inverse_e_x * p, rule.weights[j]);
  }
  if (n % 2 == 1) {
    const Wide p = sqrt(e_x);
    add(p, Wide(1.0) / p, rule.weights[n / 2]);
  }
  return sums;
}

double sum_lanes(Wide values) {
  double lane[lanes];
  store_lanes(lane, values);
  double sum = 0;
  for (double value : lane) sum += value;
  return sum;
}

}  // namespace

QuadratureOrder table_order(double mu) {
  const double wanted = 6 + 2.2 * std::log2(1 / std::max(mu, 1e-3));
  const int whole = static_cast<int>(std::ceil(wanted / lanes)) * lanes;
  return {std::clamp(whole, 8, 28), 28};
}

ViewRule make_view_rule(double mu, int azimuths) {
  ViewRule rule;
  rule.mu = std::clamp(mu, least_mu, 1.0);
  // Straight down every azimuth is alike; a tiny slope keeps the quotients below defined.
  rule.tau = std::max(std::sqrt((1 - rule.mu) * (1 + rule.mu)) / rule.mu, 1e-8);
  rule.sine = rule.tau * rule.mu;
  const int padded = (azimuths + lanes - 1) / lanes * lanes;
  rule.cos_p.assign(padded, 0.0);
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
    rule.t_max[k] = std::exp(s);
    rule.weight[k] = 2 * pi / azimuths * dp_dpsi;  // both half-planes
  }
  return rule;
}

SplitSumTerms<double> integrate_split_sum(const ViewRule& rule, double alpha, int slopes) {
  const Ggx<Wide> ggx = Ggx<Wide>::isotropic(Wide(alpha));
  const Rule& inner = unit_rule(slopes);
  View view{Wide(rule.mu), Wide(rule.sine), {}, {}, {}, {}, {}};
  view.stretched = ggx.stretched_length({view.sine, Wide(0.0), view.mu});
  Sums total;
  for (size_t k = 0; k < rule.weight.size(); k += lanes) {
    view.cos_p = load_lanes<Wide>(&rule.cos_p[k]);
    view.tau_cos_p = Wide(rule.tau) * view.cos_p;
    view.t_max = load_lanes<Wide>(&rule.t_max[k]);
    view.inverse_t_max = Wide(1.0) / view.t_max;
    const Wide weight = load_lanes<Wide>(&rule.weight[k]);
    const Sums sums = integrate_slopes(view, ggx, inner);
    total.scale = fma(weight, sums.scale, total.scale);
    total.bias = fma(weight, sums.bias, total.bias);
  }
  return {sum_lanes(total.scale), sum_lanes(total.bias)};
}

SplitSumTerms<double> integrate_split_sum(double mu, double alpha, QuadratureOrder order) {
  return integrate_split_sum(make_view_rule(mu, order.azimuths), alpha, order.slopes);
}

SplitSumTerms<double> integrate_split_sum(double mu, double alpha) {
  return integrate_split_sum(mu, alpha, table_order(mu));
}

SplitSumTerms<double> integrate_average(double alpha) {
  const Rule& rule = unit_rule(64);
  const double reach = std::asinh(1 / alpha);
  SplitSumTerms<double> average{0, 0};
  for (size_t j = 0; j < rule.nodes.size(); ++j) {
    const double x = reach * rule.nodes[j];
    const double mu = alpha * std::sinh(x);
    const double weight = 2 * mu * alpha * std::cosh(x) * reach * rule.weights[j];
    const auto terms = integrate_split_sum(mu, alpha, QuadratureOrder{32, 48});
    average.scale += weight * terms.scale;
    average.bias += weight * terms.bias;
  }
  return average;
}

}  // namespace kiln

// SPDX-License-Identifier: Apache-2.0
#include "kiln/table/skin.h"

#include <algorithm>
#include <cmath>

#include "kiln/integrate/gauss_legendre.h"

namespace kiln {
namespace {

constexpr double widths = 9;  // exp(-9^2 / 2) is 2.6e-18

// INT_from^to g(x) exp(k (cos x - 1)) dx over a span without a kink.
template <class Integrand>
double integrate_span(double from, double to, double k, const Rule& rule, const Integrand& g) {
  if (to <= from) return 0;
  double sum = 0;
  for (size_t i = 0; i < rule.nodes.size(); ++i) {
    const double x = from + (to - from) * rule.nodes[i];
    sum += rule.weights[i] * g(x) * std::exp(-2 * k * square(std::sin(x / 2)));
  }
  return sum * (to - from);
}

// The same over any span of [-pi, pi], split at the peak and no farther than it reaches.
template <class Integrand>
double integrate_peak(double from, double to, double k, const Rule& rule, const Integrand& g) {
  const double reach = std::min(pi, widths / std::sqrt(k));
  const double low = std::max(from, -reach), high = std::min(to, reach);
  const double middle = std::clamp(0.0, low, std::max(low, high));
  return integrate_span(low, middle, k, rule, g) + integrate_span(middle, high, k, rule, g);
}

// Numerator over the arc that light reaches, cos(theta + x) > 0; it may close behind the ball.
double integrate_lit(double theta, double k, const Rule& rule) {
  const auto lit = [&](double x) { return std::cos(theta + x); };
  return integrate_peak(-pi / 2 - theta, pi / 2 - theta, k, rule, lit) +
         integrate_peak(3 * pi / 2 - theta, pi, k, rule, lit);
}

}  // namespace

Vec3<double> integrate_skin(double cosine, double curvature_per_mm, int order) {
  const double mu = std::clamp(cosine, -1.0, 1.0);
  const double flat = std::max(mu, 0.0);
  if (!(curvature_per_mm > 1e-9)) return {flat, flat, flat};
  const Rule rule = gauss_legendre(order);
  const double theta = std::acos(mu);
  Vec3<double> lit, all;
  for (const ProfileGaussian& gaussian : skin_profile) {
    const double k = 1 / (gaussian.variance * square(curvature_per_mm));
    const Vec3<double> density = gaussian.weight * (1 / gaussian.variance);
    lit += density * integrate_lit(theta, k, rule);
    all += density * integrate_peak(-pi, pi, k, rule, [](double) { return 1.0; });
  }
  return {lit.x / all.x, lit.y / all.y, lit.z / all.z};
}

}  // namespace kiln

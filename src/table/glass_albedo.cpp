// SPDX-License-Identifier: Apache-2.0
#include "kiln/table/glass_albedo.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "kiln/brdf/dielectric.h"
#include "kiln/integrate/gauss_legendre.h"

namespace kiln {
namespace {

using Wide = WideDouble;
constexpr int lanes = lane_count<Wide>;
constexpr double lowest_mu = 1e-4, least_alpha = 1e-8;

// Nodes and weights of Gauss-Legendre after s^2 (3 - 2 s), padded to whole vectors by weight 0.
struct EndedRule {
  std::vector<double> nodes, weights;
};

EndedRule make_rule(int n) {
  const Rule rule = gauss_legendre(n);
  EndedRule made;
  const int padded = (n + lanes - 1) / lanes * lanes;
  made.nodes.assign(padded, 0.5);
  made.weights.assign(padded, 0.0);
  for (int i = 0; i < n; ++i) {
    const double s = rule.nodes[i];
    made.nodes[i] = s * s * (3 - 2 * s);
    made.weights[i] = rule.weights[i] * 6 * s * (1 - s);
  }
  return made;
}

struct View {
  double mu, sine, theta, alpha, eta;
  double stretched;  // |stretched wo|
};

// Facet normals at one angle from wo, azimuth counted from the normal's.
struct Ring {
  double theta, cosine, sine;
  double spread;     // B = sin(theta_o) sin(theta)
  double nearest_z;  // n.m at azimuth 0; n.m = nearest_z - 2 B sin^2(azimuth / 2)
  double nearest_q;  // |n - m|^2 at azimuth 0; |n - m|^2 = nearest_q + 4 B sin^2(azimuth / 2)
};

Ring make_ring(const View& view, double theta) {
  const double away = theta - view.theta;
  const double sine = std::sin(theta);
  return {theta,          std::cos(theta),
          sine,           view.sine * sine,
          std::cos(away), 4 * square(std::sin(away / 2))};
}

// n.i as a function of v = sin^2(azimuth / 2), and where it and n.m are above 0.
struct Arc {
  double at_zero, slope;  // n.i = at_zero + slope v
  double first, last;     // azimuths
};

// The azimuth with sin^2(azimuth / 2) = v.
double azimuth_of(double v) { return 2 * std::asin(std::sqrt(std::clamp(v, 0.0, 1.0))); }

// Reflected, n.i = 2 c n.m - mu = cos(theta_o - 2 theta) - 4 c B v.
Arc reflected_arc(const View& view, const Ring& ring) {
  const double top = std::cos(view.theta - 2 * ring.theta);
  const double fall = 4 * ring.cosine * ring.spread;
  const double last = top <= 0 ? 0 : azimuth_of(fall > 0 ? top / fall : 1);
  return {top, -fall, 0, last};
}

// Refracted, eta (-n.i) = mu + (s - c) n.m with s = eta cos(theta_t). Below `first` -n.i < 0: the
// ray is bent back above the surface.
Arc refracted_arc(const View& view, const Ring& ring) {
  const double s2 = (view.eta - 1) * (view.eta + 1) + square(ring.cosine);
  const double bend = safe_sqrt(s2) - ring.cosine;
  const double top = (view.mu + bend * ring.nearest_z) / view.eta;
  const double slope = -2 * bend * ring.spread / view.eta;
  const double last = azimuth_of(ring.spread > 0 ? ring.nearest_z / (2 * ring.spread) : 1);
  const double first = top < 0 && slope > 0 ? azimuth_of(-top / slope) : 0;
  return {top, slope, std::min(first, last), last};
}

// INT D G2 / mu over an arc of both half-planes.
double integrate_arc(const View& view, const Ring& ring, const Arc& arc, const EndedRule& rule) {
  if (arc.last <= arc.first) return 0;
  const double a2 = square(view.alpha);
  const double scale =
      std::min(std::sqrt((a2 + ring.nearest_q) / std::max(ring.spread, 1e-30)), 1e3);
  const double from = std::asinh(arc.first / scale), to = std::asinh(arc.last / scale);
  Wide sum = Wide(0.0);
  for (size_t k = 0; k < rule.nodes.size(); k += lanes) {
    const Wide y = fma(load_lanes<Wide>(&rule.nodes[k]), Wide(to - from), Wide(from));
    const Wide e = exp(y);
    const Wide inverse = Wide(1.0) / e;
    const Wide azimuth = Wide(scale / 2) * (e - inverse);
    const Wide v = square(sin(Wide(0.5) * azimuth));
    const Wide mu_i = max(fma(Wide(arc.slope), v, Wide(arc.at_zero)), Wide(0.0));
    const Wide q = fma(Wide(4 * ring.spread), v, Wide(ring.nearest_q));
    const Wide sine2 = q * fma(q, Wide(-0.25), Wide(1.0));
    const Wide d = Wide(1 / pi) * Wide(a2) / square(fma(sine2, Wide(1 - a2), Wide(a2)));
    const Wide mu_i2 = mu_i * mu_i;
    const Wide stretched_i = sqrt(fma(Wide(a2), Wide(1.0) - mu_i2, mu_i2));
    const Wide g2 = Wide(2.0) * mu_i / fma(Wide(view.stretched), mu_i, Wide(view.mu) * stretched_i);
    sum = fma(load_lanes<Wide>(&rule.weights[k]) * (e + inverse), d * g2, sum);
  }
  double lane[lanes], total = 0;
  store_lanes(lane, sum);
  for (const double x : lane) total += x;
  return total * scale * (to - from);
}

// Sums over rings between neighbouring edges.
template <class OfRing>
double integrate_rings(const View& view, std::vector<double> edges, double last,
                       const EndedRule& rule, const OfRing& of_ring) {
  for (double& edge : edges) edge = std::clamp(edge, 0.0, last);
  edges.push_back(0);
  edges.push_back(last);
  std::sort(edges.begin(), edges.end());
  double sum = 0;
  for (size_t piece = 0; piece + 1 < edges.size(); ++piece) {
    const double from = std::asinh((edges[piece] - view.theta) / view.alpha);
    const double to = std::asinh((edges[piece + 1] - view.theta) / view.alpha);
    if (to - from < 1e-14) continue;
    for (size_t j = 0; j < rule.nodes.size(); ++j) {
      const double x = from + (to - from) * rule.nodes[j];
      const double theta = view.theta + view.alpha * std::sinh(x);
      const Ring ring = make_ring(view, std::clamp(theta, edges[piece], edges[piece + 1]));
      const double dtheta = view.alpha * std::cosh(x) * (to - from) * rule.weights[j];
      sum += dtheta * ring.sine * ring.cosine * of_ring(ring);
    }
  }
  return sum;
}

double critical_angle(const View& view) { return view.eta < 1 ? std::asin(view.eta) : pi / 2; }

double integrate_reflected(const View& view, const EndedRule& arcs, const EndedRule& rings) {
  return integrate_rings(view, {(pi / 2 - view.theta) / 2, critical_angle(view), view.theta},
                         (pi / 2 + view.theta) / 2, rings, [&](const Ring& ring) {
                           return Dielectric<double>{view.eta}.eval(ring.cosine) *
                                  integrate_arc(view, ring, reflected_arc(view, ring), arcs);
                         });
}

// Sums over the arcs that `choose` makes of those refracted.
template <class Choose>
double integrate_refracted(const View& view, const EndedRule& arcs, const EndedRule& rings,
                           const Choose& choose) {
  const double left = pi / 2 - view.theta;
  // Where refraction bends by `left`: sin(theta) = eta sin(theta + left).
  const double bent =
      std::atan2(view.eta * std::sin(left), 1 - std::min(view.eta, 1.0) * std::cos(left));
  return integrate_rings(
      view, {bent, left, view.theta}, critical_angle(view), rings, [&](const Ring& ring) {
        return (1 - Dielectric<double>{view.eta}.eval(ring.cosine)) *
               integrate_arc(view, ring, choose(refracted_arc(view, ring)), arcs);
      });
}

// n.i of rays bent back, up to the azimuth where they meet the surface.
Arc bent_back(const Arc& arc) { return {-arc.at_zero, -arc.slope, 0, arc.first}; }

View make_view(double mu, double alpha, double eta) {
  View view{};
  view.mu = std::clamp(mu, lowest_mu, 1.0);
  view.sine = std::sqrt((1 - view.mu) * (1 + view.mu));
  view.theta = std::atan2(view.sine, view.mu);
  view.alpha = std::clamp(alpha, least_alpha, 1.0);
  view.eta = eta;
  view.stretched = std::hypot(view.alpha * view.sine, view.mu);
  return view;
}

GlassTerms integrate_view(const View& view, const EndedRule& arcs, const EndedRule& rings) {
  GlassTerms terms;
  terms.reflected = integrate_reflected(view, arcs, rings);
  terms.transmitted = integrate_refracted(view, arcs, rings, [](const Arc& arc) { return arc; });
  if (view.eta < 1) terms.strayed = integrate_refracted(view, arcs, rings, bent_back);
  return terms;
}

// Tails far below alpha = 1e-4 spread over more decades and ask for more points.
QuadratureOrder order_for(double alpha, QuadratureOrder order) {
  const double decades = -4 - std::log10(std::clamp(alpha, least_alpha, 1e-4));
  const double more = 1 + decades / 6;
  return {static_cast<int>(std::lround(order.azimuths * more)),
          static_cast<int>(std::lround(order.slopes * more))};
}

// A span of cosines, dense by sinh at `from` down to `scale`; `to` may lie on either side.
struct CosineSpan {
  double from, to, scale;
};

// The average is smooth but at 0, where total reflection begins (there washed out by the width of
// the lobe), and where an edge of the rings meets another.
std::vector<CosineSpan> cosine_spans(double alpha, double eta) {
  const double step = std::sqrt(std::max(std::abs(eta - 1) * (eta + 1), 1e-8));
  const double start = std::min(alpha, step);
  if (eta >= 1) return {{0, 1, start}};
  const double critical = std::min(std::sqrt((1 - eta) * (1 + eta)), 1.0);
  std::vector<double> edges{0, critical, eta, 2 * eta * critical, 1};
  std::sort(edges.begin(), edges.end());
  std::vector<CosineSpan> spans;
  spans.reserve(2 * edges.size());
  for (size_t i = 0; i + 1 < edges.size(); ++i) {
    const double low = edges[i], high = edges[i + 1], middle = (low + high) / 2;
    const double at_low = low == 0 ? start : alpha;
    const bool dense_low = low == 0 || low == critical, dense_high = high == critical;
    if (high - low < 1e-12) continue;
    if (dense_low && dense_high) {
      spans.push_back({low, middle, at_low});
      spans.push_back({high, middle, alpha});
    } else if (dense_high) {
      spans.push_back({high, low, alpha});
    } else {
      spans.push_back({low, high, dense_low ? at_low : 1.0});
    }
  }
  return spans;
}

void add_cosines(const CosineSpan& span, double alpha, double eta, const EndedRule& arcs,
                 const EndedRule& rings, GlassTerms& sum) {
  static const EndedRule rule = make_rule(28);
  const double reach = std::asinh((span.to - span.from) / span.scale);
  for (size_t j = 0; j < rule.nodes.size(); ++j) {
    const double x = reach * rule.nodes[j];
    const double mu = span.from + span.scale * std::sinh(x);
    const double weight = 2 * mu * span.scale * std::cosh(x) * std::abs(reach) * rule.weights[j];
    const GlassTerms terms = integrate_view(make_view(mu, alpha, eta), arcs, rings);
    sum.reflected += weight * terms.reflected;
    sum.transmitted += weight * terms.transmitted;
    sum.strayed += weight * terms.strayed;
  }
}

}  // namespace

GlassTerms integrate_glass(double mu, double alpha, double eta, QuadratureOrder order) {
  const QuadratureOrder points = order_for(alpha, order);
  return integrate_view(make_view(mu, alpha, eta), make_rule(points.azimuths),
                        make_rule(points.slopes));
}

GlassTerms integrate_glass_average(double alpha, double eta, QuadratureOrder order) {
  const QuadratureOrder points = order_for(alpha, order);
  const EndedRule arcs = make_rule(points.azimuths), rings = make_rule(points.slopes);
  GlassTerms sum;
  for (const CosineSpan& span : cosine_spans(std::clamp(alpha, least_alpha, 1.0), eta)) {
    add_cosines(span, alpha, eta, arcs, rings, sum);
  }
  return sum;
}

}  // namespace kiln

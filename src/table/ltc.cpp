// SPDX-License-Identifier: Apache-2.0
#include "kiln/table/ltc.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "kiln/brdf/ggx.h"
#include "kiln/brdf/roughness.h"
#include "kiln/brdf/smith.h"
#include "kiln/integrate/gauss_legendre.h"
#include "kiln/parallel/rows.h"
#include "kiln/table/view_rule.h"
#include "lane_sum.h"

namespace kiln {
namespace {

using Wide = WideDouble;
constexpr int lanes = lane_count<Wide>;
constexpr QuadratureOrder measure_order{96, 96};

// Near grazing a cosine lobe can hide a spike, toward the viewer, between too few points.
QuadratureOrder fit_order(double mu) {
  return mu < 0.3 ? QuadratureOrder{64, 64} : QuadratureOrder{32, 32};
}

// Directions of half the sphere with their solid angles (both halves) and f cos / E, in whole
// vectors; then the mirror images below the horizon, where f is 0.
struct Samples {
  std::vector<double> x, y, z, weight, value;
  Vec3<double> mean;  // of the lobe
};

void add_sample(Samples& samples, const Vec3<double>& w, double weight, double value) {
  samples.x.push_back(w.x);
  samples.y.push_back(w.y);
  samples.z.push_back(w.z);
  samples.weight.push_back(weight);
  samples.value.push_back(value);
}

void normalize_lobe(Samples& samples) {
  double albedo = 0;
  Vec3<double> sum;
  const size_t count = samples.x.size();
  for (size_t i = 0; i < count; ++i) {
    const double share = samples.weight[i] * samples.value[i];
    albedo += share;
    sum += Vec3<double>{samples.x[i], 0, samples.z[i]} * share;
  }
  for (double& value : samples.value) value /= std::max(albedo, 1e-300);
  const double size = length(sum);
  samples.mean = size > 0 ? sum * (1 / size) : Vec3<double>{0, 0, 1};
}

// The points of the quadrature behind the albedo: azimuths of slopes t = alpha sinh x up to the
// horizon, with dwi = 4 c t dt dp / (1 + t^2)^(3/2).
Samples sample_lobe(double mu, double alpha, const LtcLobe& lobe, QuadratureOrder order) {
  const ViewRule view = make_view_rule(mu, order.azimuths);
  const Rule inner = gauss_legendre(order.slopes);
  const Vec3<double> wo{view.sine, 0, view.mu};
  Samples samples;
  for (auto* values : {&samples.x, &samples.y, &samples.z, &samples.weight, &samples.value}) {
    values->reserve(2 * view.weight.size() * inner.nodes.size());
  }
  for (size_t k = 0; k < view.weight.size(); ++k) {
    const double cos_p = view.cos_p[k], sin_p = view.sin_p[k];
    const double reach = std::asinh(view.t_max[k] / alpha);
    for (size_t j = 0; j < inner.nodes.size(); ++j) {
      const double t = alpha * std::sinh(reach * inner.nodes[j]);
      const double dt = alpha * std::cosh(reach * inner.nodes[j]) * reach * inner.weights[j];
      const double scale = 1 / std::sqrt(1 + t * t);
      const Vec3<double> wm{t * cos_p * scale, t * sin_p * scale, scale};
      const double cosine = dot(wo, wm);
      Vec3<double> wi = wm * (2 * cosine) - wo;
      wi.z = std::max(wi.z, 1e-12);
      const double solid_angle =
          view.weight[k] * std::max(4 * cosine, 0.0) * t * dt * scale * scale * scale;
      add_sample(samples, wi, solid_angle, lobe(alpha, wo, wi));
    }
  }
  normalize_lobe(samples);
  const size_t count = samples.x.size();
  for (size_t i = 0; i < count; ++i) {
    add_sample(samples, {samples.x[i], samples.y[i], -samples.z[i]}, samples.weight[i], 0);
  }
  return samples;
}

// m11, m13, m31, m33 of the inverse.
using Entries = std::array<double, 4>;

template <class F>
struct Density {
  F value;
  std::array<F, 4> slope;  // derivatives
};

// D = det q_z / (pi |q|^4), and by logarithmic differentiation its derivatives, in which q_z stays
// out of the denominators.
Density<Wide> density_of(const Entries& m, Wide x, Wide y, Wide z) {
  const double determinant = m[0] * m[3] - m[1] * m[2];
  const Wide qx = fma(Wide(m[0]), x, Wide(m[1]) * z);
  const Wide qz = max(fma(Wide(m[2]), x, Wide(m[3]) * z), Wide(0.0));
  const Wide inverse = Wide(1.0) / fma(qx, qx, fma(y, y, qz * qz));
  const Wide scale = Wide(1 / pi) * inverse * inverse;
  const Wide of_qz = Wide(determinant) * scale;  // D / q_z
  const Wide value = of_qz * qz;
  const Wide by_qx = Wide(-4.0) * qx * inverse * value;
  const Wide by_qz =
      select(qz > Wide(0.0), fma(Wide(-4.0) * qz * inverse, value, of_qz), Wide(0.0));
  const Wide by_determinant = scale * qz;
  return {
      value,
      {fma(by_qx, x, by_determinant * Wide(m[3])), fma(by_qx, z, by_determinant * Wide(-m[2])),
       fma(by_qz, x, by_determinant * Wide(-m[1])), fma(by_qz, z, by_determinant * Wide(m[0]))}};
}

// INT |D - f cos / E|^3, its gradient and the matrix of Gauss and Newton's method.
struct Objective {
  double value = 0;
  Entries gradient{};
  std::array<Entries, 4> curvature{};
};

Objective evaluate(const Entries& m, const Samples& samples) {
  Wide value = Wide(0.0);
  std::array<Wide, 4> gradient;
  std::array<Wide, 10> curvature;
  gradient.fill(Wide(0.0));
  curvature.fill(Wide(0.0));
  for (size_t k = 0; k < samples.x.size(); k += lanes) {
    const auto at = [&](const std::vector<double>& v) { return load_lanes<Wide>(&v[k]); };
    const Density<Wide> d = density_of(m, at(samples.x), at(samples.y), at(samples.z));
    const Wide r = d.value - at(samples.value);
    const Wide weighted = at(samples.weight) * abs(r);
    value = fma(weighted, r * r, value);
    for (int i = 0, entry = 0; i < 4; ++i) {
      const Wide row = weighted * d.slope[i];
      gradient[i] = fma(row, r, gradient[i]);
      for (int j = 0; j <= i; ++j, ++entry) {
        curvature[entry] = fma(row, d.slope[j], curvature[entry]);
      }
    }
  }
  Objective sum;
  sum.value = sum_lanes(value);
  for (int i = 0, entry = 0; i < 4; ++i) {
    sum.gradient[i] = 3 * sum_lanes(gradient[i]);
    for (int j = 0; j <= i; ++j, ++entry) {
      sum.curvature[i][j] = sum.curvature[j][i] = 6 * sum_lanes(curvature[entry]);
    }
  }
  return sum;
}

// Solves (curvature + damping diagonal) step = -gradient by Cholesky's method; straight down only
// m33 moves.
Entries damped_step(const Objective& at, double damping, bool upright) {
  std::array<Entries, 4> l{};
  Entries step{};
  for (int i = 0; i < 4; ++i) {
    const bool fixed = upright && i < 3;
    double rest = fixed ? 0 : -at.gradient[i];
    for (int j = 0; j <= i; ++j) {
      double entry = at.curvature[i][j] * (i == j ? 1 + damping : 1);
      if (upright && (i < 3 || j < 3)) entry = i == j ? 1 : 0;
      for (int k = 0; k < j; ++k) entry -= l[i][k] * l[j][k];
      l[i][j] = i == j ? std::sqrt(std::max(entry, 1e-300)) : entry / l[j][j];
    }
    for (int k = 0; k < i; ++k) rest -= l[i][k] * step[k];
    step[i] = rest / l[i][i];
  }
  for (int i = 3; i >= 0; --i) {
    for (int k = i + 1; k < 4; ++k) step[i] -= l[k][i] * step[k];
    step[i] /= l[i][i];
  }
  return step;
}

struct Fit {
  Entries entries{};
  double objective = 0;
};

Fit descend(const Entries& start, const Samples& samples, bool upright) {
  Entries best = start;
  Objective at = evaluate(best, samples);
  double damping = 1e-3;
  for (int iteration = 0; iteration < 60 && damping < 1e9; ++iteration) {
    const Entries step = damped_step(at, damping, upright);
    Entries tried = best;
    for (int i = 0; i < 4; ++i) tried[i] += step[i];
    const bool valid = tried[0] * tried[3] - tried[1] * tried[2] > 0;
    const Objective next = valid ? evaluate(tried, samples) : Objective{};
    if (!valid || !(next.value < at.value)) {
      damping *= 8;
      continue;
    }
    const double gain = at.value - next.value;
    best = tried;
    at = next;
    damping = std::max(damping / 6, 1e-12);
    if (gain < 1e-9 * at.value) break;
  }
  return {best, at.value};
}

// A lobe about z; `across` is its width across the plane of view over that within.
Entries guess(const Vec3<double>& z, double width, double across) {
  return {across * z.z, -across * z.x, width * z.x, width * z.z};
}

// The nearest of what a start and three guesses lead to: round about the mean direction, mu times
// as wide across there, and as narrow lobes are: about the mirrored direction, 2 alpha wide, and 2
// alpha mu across.
Fit descend_from_all(const Entries& given, double mu, double alpha, const Samples& samples) {
  const bool upright = mu >= 1;
  const Vec3<double> mirror{-std::sqrt((1 - mu) * (1 + mu)), 0, mu};
  const Vec3<double>& mean = upright ? mirror : samples.mean;
  const double width = std::min(1.0, 1.5 * alpha);
  Fit best = descend(given, samples, upright);
  for (const Entries& start : {guess(mean, width, 1), guess(mean, width, mean.z),
                               guess(mirror, std::min(1.0, 2 * alpha * mu), mu)}) {
    const Fit other = descend(start, samples, upright);
    if (!(best.objective <= other.objective)) best = other;  // also from one that is no number
  }
  return best;
}

double measure_l1(const LtcCell& cell, const Samples& samples) {
  double sum = 0;
  for (size_t i = 0; i < samples.x.size(); ++i) {
    const double d = ltc_density(cell, {samples.x[i], samples.y[i], samples.z[i]});
    sum += samples.weight[i] * std::abs(d - samples.value[i]);
  }
  return sum / 2;
}

}  // namespace

LtcLobe ggx_ltc_lobe() {
  return [](double alpha, const Vec3<double>& wo, const Vec3<double>& wi) {
    const auto ggx = Ggx<double>::isotropic(alpha);
    const Vec3<double> wm = normalize(wo + wi);
    return ggx.D(wm) * SmithCorrelated<double>::visibility(ggx, wo, wi, wm) * wi.z;
  };
}

double ltc_density(const LtcCell& cell, const Vec3<double>& w) {
  const double qx = cell.m11 * w.x + cell.m13 * w.z, qz = cell.m31 * w.x + cell.m33 * w.z;
  return std::max(qz, 0.0) * cell.determinant() / (pi * square(qx * qx + w.y * w.y + qz * qz));
}

LtcErrors measure_ltc(const LtcCell& cell, double mu, double alpha, const LtcLobe& lobe) {
  const Samples samples = sample_lobe(mu, alpha, lobe, measure_order);
  const Entries entries{cell.m11, cell.m13, cell.m31, cell.m33};
  return {measure_l1(cell, samples), evaluate(entries, samples).value};
}

LtcCell fit_ltc_cell(double mu, double alpha, const LtcLobe& lobe, const LtcCell& start) {
  const Samples samples = sample_lobe(mu, alpha, lobe, fit_order(mu));
  const bool upright = mu >= 1;
  const Entries given =
      upright ? Entries{1, 0, 0, start.m33} : Entries{start.m11, start.m13, start.m31, start.m33};
  const Entries m = descend_from_all(given, mu, alpha, samples).entries;
  LtcCell cell{m[0], m[2], m[1], m[3]};
  cell.error = measure_l1(cell, samples);
  return cell;
}

double ltc_cosine(int row, int rows) {
  const double t = static_cast<double>(row) / (rows - 1);
  return std::max(1 - t * t, std::cos(1.57));
}

std::vector<LtcCell> fit_ltc(Size size, const LtcLobe& lobe) {
  std::vector<LtcCell> cells(static_cast<size_t>(size.width) * size.height);
  for_rows(size.height, [&](int row) {
    const double mu = ltc_cosine(row, size.height);
    LtcCell start;
    double alpha_before = 1;
    for (int column = size.width - 1; column >= 0; --column) {
      const double alpha = to_alpha(static_cast<double>(column) / (size.width - 1));
      start.m31 *= alpha / alpha_before;
      start.m33 *= alpha / alpha_before;
      start = fit_ltc_cell(mu, alpha, lobe, start);
      cells[static_cast<size_t>(row) * size.width + column] = start;
      alpha_before = alpha;
    }
  });
  return cells;
}

}  // namespace kiln

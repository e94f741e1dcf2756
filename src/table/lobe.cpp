// SPDX-License-Identifier: Apache-2.0
#include "kiln/table/lobe.h"

#include <algorithm>
#include <cmath>

#include "kiln/brdf/roughness.h"
#include "kiln/parallel/rows.h"
#include "lane_sum.h"
#include "lobe_kernels.h"
#include "smooth_field.h"

namespace kiln {
namespace {

template <int Points>
const Rule& made_once() {
  static const Rule rule = gauss_legendre(Points);
  return rule;
}

// Rules are asked for again and again, and made when they first are.
const Rule& unit_rule(int points) {
  switch (points) {
    case 40:
      return made_once<40>();
    case 80:
      return made_once<80>();
    case 128:
      return made_once<128>();
    case 160:
      return made_once<160>();
    case 192:
      return made_once<192>();
    default:
      return made_once<most_slopes>();
  }
}

double greatest_error(const std::vector<LobeTerms>& found, const std::vector<LobeTerms>& truth) {
  double greatest = 0;
  for (size_t i = 0; i < found.size(); ++i) {
    const double scale = std::abs(found[i].scale - truth[i].scale);
    const double unit = std::max(truth[i].total(), 1.0);
    greatest = std::max({greatest, scale / std::max(std::abs(truth[i].scale), 1e-12),
                         std::abs(found[i].bias - truth[i].bias) / unit,
                         std::abs(found[i].edge - truth[i].edge)});
  }
  return greatest;
}

// Steep views need fewer azimuths, for the integrand hardly changes over them.
QuadratureOrder order_of(double kinked_below, Quality quality, double mu) {
  if (mu < kinked_below) {
    constexpr QuadratureOrder orders[] = {{96, 128}, {128, 160}, {192, 192}, {256, 256}};
    return orders[static_cast<int>(quality)];
  }
  constexpr QuadratureOrder orders[] = {{40, 40}, {64, 80}, {96, 160}, {128, 192}};
  QuadratureOrder order = orders[static_cast<int>(quality)];
  const double share = (12 + 2.4 * std::log2(1 / std::max(mu, least_mu))) / 32;
  order.azimuths = static_cast<int>(std::ceil(order.azimuths * std::clamp(share, 0.4, 1.0)));
  return order;
}

}  // namespace

Quality finer(Quality quality) {
  return static_cast<Quality>(std::min(static_cast<int>(quality) + 1, 3));
}

struct LobeIntegrals::Work {
  LobeKernels kernels;
  FresnelStage stage;
  double shape = 0;
  Quality quality = Quality::Table;
  double floor_mu = least_mu;
  std::unique_ptr<SmoothField> field;
  bool field_failed = false;

  LobeTerms integrate(const ViewRule& view, const LobePoint& point, int slopes) const {
    Wide sums[most_sums] = {Wide(0.0), Wide(0.0), Wide(0.0)};
    if (point.alpha_x <= 0 && kernels.mirror) {
      kernels.mirror(view, shape, stage, sums);
    } else {
      const double x = std::clamp(point.alpha_x, min_alpha, 1.0);
      const double y = std::clamp(point.alpha_y, min_alpha, 1.0);
      kernels.integrate(view, {x, y, shape, point.azimuth}, unit_rule(slopes), stage, sums);
    }
    return {sum_lanes(sums[0]), sum_lanes(sums[1]), sum_lanes(sums[2])};
  }

  std::vector<LobeTerms> column(double mu, std::span<const double> alphas, Quality wanted) const {
    const QuadratureOrder order = order_of(kernels.kinked_below, wanted, mu);
    const ViewRule view = make_view_rule(mu, order.azimuths);
    std::vector<LobeTerms> terms;
    terms.reserve(alphas.size());
    for (const double alpha : alphas) {
      terms.push_back(integrate(view, {mu, alpha, alpha, 0}, order.slopes));
    }
    return terms;
  }

  std::vector<LobeTerms> direct(std::span<const double> mus, std::span<const double> alphas,
                                Quality wanted) const {
    constexpr size_t least_rows = 16;  // few directions are cut into runs, to occupy all threads
    const size_t n = std::max<size_t>(mus.size(), 1), widths = alphas.size();
    const size_t runs = std::clamp<size_t>(least_rows / n, 1, std::max<size_t>(widths, 1));
    std::vector<LobeTerms> terms(mus.size() * widths);
    for_rows(static_cast<int>(mus.size() * runs), [&](int row) {
      const size_t i = row % n, run = row / n;
      const size_t first = widths * run / runs, last = widths * (run + 1) / runs;
      const auto one = column(mus[i], alphas.subspan(first, last - first), wanted);
      for (size_t j = first; j < last; ++j) terms[j * n + i] = one[j - first];
    });
    return terms;
  }

  // Rows of zero width lie outside the field.
  void replace_mirrors(std::span<const double> mus, std::span<const double> alphas,
                       std::vector<LobeTerms>& terms) const {
    for (size_t j = 0; j < alphas.size(); ++j) {
      if (alphas[j] > 0) continue;
      const std::vector<LobeTerms> row = direct(mus, alphas.subspan(j, 1), quality);
      std::copy(row.begin(), row.end(), terms.begin() + static_cast<long>(j * mus.size()));
    }
  }

  // Between the nodes, where an interpolant errs most.
  double measure(const SmoothField& candidate) const {
    std::vector<double> mus, alphas;
    const LogAxis mu{floor_mu, 1, 17}, alpha{min_alpha, 1, 19};
    for (int i = 0; i < mu.count; ++i) mus.push_back(mu.node(i));
    for (int j = 0; j < alpha.count; ++j) alphas.push_back(alpha.node(j));
    mus.push_back(floor_mu);
    mus.push_back(1);
    alphas.push_back(min_alpha);
    alphas.push_back(1);
    return greatest_error(candidate.grid(mus, alphas), direct(mus, alphas, quality));
  }

  // Grows until it repeats the quadrature, or gives up.
  void build_field() {
    const double smooth = quality == Quality::Table ? 2e-7 : 2e-11;
    const double tolerance = kernels.kinked_below > 1 ? 5e-5 : smooth;
    const double decades = std::log10(1 / floor_mu);
    int mus = static_cast<int>((quality == Quality::Table ? 14 : 21) * decades) + 2;
    int alphas = quality == Quality::Table ? 48 : 84;
    for (int attempt = 0; attempt < 2; ++attempt, mus = mus * 3 / 2, alphas = alphas * 3 / 2) {
      auto candidate = std::make_unique<SmoothField>(
          LogAxis{floor_mu, 1, mus}, LogAxis{min_alpha, 1, alphas},
          [&](double mu, std::span<const double> widths) { return column(mu, widths, quality); });
      if (measure(*candidate) > tolerance) continue;
      field = std::move(candidate);
      return;
    }
    field_failed = true;
  }
};

LobeIntegrals::LobeIntegrals(const Lobe& lobe, const FresnelChoice& fresnel, Quality quality,
                             double floor_mu)
    : work_(std::make_unique<Work>()) {
  work_->kernels = find_lobe_kernels(lobe.distribution, lobe.masking);
  work_->shape = shape_of(lobe.distribution, lobe.shape);
  work_->stage = {find_fresnel_stage(fresnel.name), fresnel.parameters};
  work_->quality = quality;
  work_->floor_mu = std::clamp(floor_mu, least_mu, 0.5);
}

LobeIntegrals::~LobeIntegrals() = default;
LobeIntegrals::LobeIntegrals(LobeIntegrals&&) noexcept = default;
LobeIntegrals& LobeIntegrals::operator=(LobeIntegrals&&) noexcept = default;

LobeTerms LobeIntegrals::at(const LobePoint& point) const {
  // An anisotropic lobe changes over the azimuth however steep the view.
  const double aspect = std::max(point.alpha_x / point.alpha_y, point.alpha_y / point.alpha_x);
  const bool isotropic = point.alpha_x == point.alpha_y;
  QuadratureOrder order =
      order_of(work_->kernels.kinked_below, work_->quality, isotropic ? point.mu : least_mu);
  if (!isotropic) order.azimuths *= 1 + static_cast<int>(std::min(aspect, 16.0) / 2);
  return work_->integrate(make_view_rule(point.mu, order.azimuths), point, order.slopes);
}

GridMeans LobeIntegrals::means_for(std::span<const double> mus,
                                   std::span<const double> alphas) const {
  constexpr size_t worth_a_field = 4000;
  const bool inside =
      std::all_of(mus.begin(), mus.end(), [&](double mu) { return mu >= work_->floor_mu; });
  return inside && mus.size() * alphas.size() >= worth_a_field ? GridMeans::Field
                                                               : GridMeans::Quadrature;
}

std::vector<LobeTerms> LobeIntegrals::grid(std::span<const double> mus,
                                           std::span<const double> alphas) {
  return grid(mus, alphas, means_for(mus, alphas));
}

std::vector<LobeTerms> LobeIntegrals::grid(std::span<const double> mus,
                                           std::span<const double> alphas, GridMeans means) {
  if (means == GridMeans::Field && !work_->field && !work_->field_failed) work_->build_field();
  if (means == GridMeans::Quadrature || work_->field_failed) {
    return work_->direct(mus, alphas, work_->quality);
  }
  std::vector<LobeTerms> terms = work_->field->grid(mus, alphas);
  work_->replace_mirrors(mus, alphas, terms);
  return terms;
}

LobeTerms LobeIntegrals::average(double alpha) const {
  const Rule& rule = made_once<64>();
  const double width = std::max(alpha, min_alpha);
  const double reach = std::asinh(1 / width);
  LobeTerms average;
  for (size_t j = 0; j < rule.nodes.size(); ++j) {
    const double x = reach * rule.nodes[j];
    const double mu = width * std::sinh(x);
    const double weight = 2 * mu * width * std::cosh(x) * reach * rule.weights[j];
    const LobeTerms terms = at({mu, alpha, alpha, 0});
    average.scale += weight * terms.scale;
    average.bias += weight * terms.bias;
    average.edge += weight * terms.edge;
  }
  return average;
}

std::vector<SplitSumTerms<double>> integrate_grid(const Lobe& lobe, std::span<const double> mus,
                                                  std::span<const double> alphas, Quality quality) {
  const double floor_mu = mus.empty() ? 1 : *std::min_element(mus.begin(), mus.end());
  LobeIntegrals integrals(lobe, {}, quality, floor_mu);
  std::vector<SplitSumTerms<double>> terms;
  terms.reserve(mus.size() * alphas.size());
  for (const LobeTerms& one : integrals.grid(mus, alphas)) terms.push_back({one.scale, one.bias});
  return terms;
}

}  // namespace kiln

// SPDX-License-Identifier: Apache-2.0
#include "integrals.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "kiln/parallel/rows.h"

namespace kiln::validate {
namespace {

constexpr double grazing_mu = 1e-3;
constexpr int mu_nodes = 49, alpha_nodes = 41;  // of fields: mu = u^2, alpha = v^2

// Integrals end where single precision would.
std::vector<double> at_least(std::vector<double> values) {
  for (double& value : values) value = std::max(value, 1e-4);
  return values;
}

std::vector<double> squares_of_nodes(int count) {
  std::vector<double> squares(count);
  for (int i = 0; i < count; ++i) {
    const double u = static_cast<double>(i) / (count - 1);
    squares[i] = u * u;
  }
  return at_least(std::move(squares));
}

// Four nodes about a place and their weights.
struct Stencil {
  int first = 0;
  std::array<double, 4> weights{};
};

Stencil stencil_at(double square, int count) {
  const double x = std::sqrt(std::clamp(square, 0.0, 1.0)) * (count - 1);
  Stencil stencil;
  stencil.first = std::clamp(static_cast<int>(x) - 1, 0, count - 4);
  const double t = x - stencil.first;  // nodes at 0, 1, 2, 3
  stencil.weights = {-(t - 1) * (t - 2) * (t - 3) / 6, t * (t - 2) * (t - 3) / 2,
                     -t * (t - 1) * (t - 3) / 2, t * (t - 1) * (t - 2) / 6};
  return stencil;
}

void add(Terms& sum, const Terms& terms, double weight) {
  sum.scale += weight * terms.scale;
  sum.bias += weight * terms.bias;
  sum.edge += weight * terms.edge;
}

Terms interpolate(const Stencil& stencil, const Terms* terms, int stride) {
  Terms sum;
  for (int k = 0; k < 4; ++k) {
    add(sum, terms[static_cast<size_t>(stencil.first + k) * stride], stencil.weights[k]);
  }
  return sum;
}

std::vector<Field> make_fields(bool rare) {
  std::vector<Field> fields;
  for (const TriedLobe& one : tried_lobes()) {
    if (one.rare == rare) fields.emplace_back(one.lobe);
  }
  return fields;
}

}  // namespace

Grid exact_grid(const Lobe& lobe, const std::vector<double>& mus,
                const std::vector<double>& alphas) {
  LobeIntegrals integrals(lobe, {}, Quality::Table);
  const std::vector<double> grazing{grazing_mu}, widths = at_least(alphas);
  return {integrals.grid(at_least(mus), widths), integrals.grid(grazing, widths)};
}

Grid exact_averages(const Lobe& lobe, const std::vector<double>& alphas) {
  const LobeIntegrals integrals(lobe, {}, Quality::Table);
  Grid grid{std::vector<Terms>(alphas.size()), {}};
  for_rows(static_cast<int>(alphas.size()),
           [&](int j) { grid.terms[j] = integrals.average(std::max(alphas[j], 1e-4)); });
  grid.grazing = grid.terms;
  return grid;
}

Field::Field(const Lobe& lobe) {
  const std::vector<double> mus = squares_of_nodes(mu_nodes);
  terms_ = LobeIntegrals(lobe, {}, Quality::Table).grid(mus, squares_of_nodes(alpha_nodes));
  averages_.resize(alpha_nodes);
  // 2 INT E mu dmu = 4 INT E u^3 du, by Simpson's rule.
  for (int j = 0; j < alpha_nodes; ++j) {
    for (int i = 0; i < mu_nodes; ++i) {
      const double u = static_cast<double>(i) / (mu_nodes - 1);
      const double simpson = i == 0 || i == mu_nodes - 1 ? 1 : i % 2 == 1 ? 4 : 2;
      add(averages_[j], terms_[static_cast<size_t>(j) * mu_nodes + i],
          4 * u * u * u * simpson / (3 * (mu_nodes - 1)));
    }
  }
}

Grid Field::grid(const std::vector<double>& mus, const std::vector<double>& alphas) const {
  std::vector<Stencil> columns;
  columns.reserve(mus.size() + 1);
  for (const double mu : mus) columns.push_back(stencil_at(mu, mu_nodes));
  columns.push_back(stencil_at(grazing_mu, mu_nodes));
  Grid grid;
  grid.terms.reserve(mus.size() * alphas.size());
  grid.grazing.reserve(alphas.size());
  std::vector<Terms> row(mu_nodes);
  for (const double alpha : alphas) {
    const Stencil across = stencil_at(alpha, alpha_nodes);
    for (int i = 0; i < mu_nodes; ++i) row[i] = interpolate(across, &terms_[i], mu_nodes);
    for (size_t i = 0; i < mus.size(); ++i) {
      grid.terms.push_back(interpolate(columns[i], row.data(), 1));
    }
    grid.grazing.push_back(interpolate(columns.back(), row.data(), 1));
  }
  return grid;
}

Grid Field::averages(const std::vector<double>& alphas) const {
  Grid grid;
  grid.terms.reserve(alphas.size());
  for (const double alpha : alphas) {
    grid.terms.push_back(interpolate(stencil_at(alpha, alpha_nodes), averages_.data(), 1));
  }
  grid.grazing = grid.terms;
  return grid;
}

const Field& field_of(int lobe) {
  static const std::vector<Field> common = make_fields(false);
  size_t place = 0;
  const bool rare = tried_lobes()[lobe].rare;
  for (int k = 0; k < lobe; ++k) place += tried_lobes()[k].rare == rare ? 1 : 0;
  if (!rare) return common[place];
  static const std::vector<Field> others = make_fields(true);
  return others[place];
}

Terms mirror_terms(double mu) {
  const double bias = std::pow(1 - mu, 5);
  return {1 - bias, bias, mu * std::pow(1 - mu, 6)};
}

}  // namespace kiln::validate

// SPDX-License-Identifier: Apache-2.0
#include "integrals.h"

#include <algorithm>
#include <cmath>

#include "kiln/integrate/gauss_legendre.h"

namespace kiln::validate {
namespace {

void make_unique(std::vector<double>& values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
}

constexpr double grazing_mu = 1e-3;

// Integrals end where single precision would.
std::vector<double> at_least(std::vector<double> values) {
  for (double& value : values) value = std::max(value, 1e-4);
  return values;
}

std::vector<size_t> places(const std::vector<double>& sorted, const std::vector<double>& wanted) {
  std::vector<size_t> found;
  found.reserve(wanted.size());
  for (const double value : wanted) {
    const auto at = std::lower_bound(sorted.begin(), sorted.end(), value);
    found.push_back(static_cast<size_t>(at - sorted.begin()));
  }
  return found;
}

}  // namespace

Integrals::Integrals(const Lobe& lobe, std::vector<double> mus, std::vector<double> alphas)
    : mus_(std::move(mus)), alphas_(std::move(alphas)) {
  mus_.push_back(grazing_mu);
  make_unique(mus_);
  make_unique(alphas_);
  terms_ = integrate_grid(lobe, at_least(mus_), at_least(alphas_), Quality::Table);
}

Integrals Integrals::averages(const Lobe& lobe, std::vector<double> alphas) {
  Integrals made;
  made.mus_ = {1};  // stands for itself where a grazing one is asked for, too
  made.alphas_ = std::move(alphas);
  make_unique(made.alphas_);
  // With mu = u^2 the Gauss points crowd where lobes change fastest.
  const Rule rule = gauss_legendre(40);
  std::vector<double> mus(rule.nodes.size());
  std::transform(rule.nodes.begin(), rule.nodes.end(), mus.begin(), [](double u) { return u * u; });
  const std::vector<Terms> terms =
      integrate_grid(lobe, mus, at_least(made.alphas_), Quality::Table);
  made.terms_.reserve(made.alphas_.size());
  for (size_t j = 0; j < made.alphas_.size(); ++j) {
    Terms average{0, 0};
    for (size_t i = 0; i < mus.size(); ++i) {
      const double weight = 4 * mus[i] * rule.nodes[i] * rule.weights[i];
      average.scale += weight * terms[j * mus.size() + i].scale;
      average.bias += weight * terms[j * mus.size() + i].bias;
    }
    made.terms_.push_back(average);
  }
  return made;
}

Grid Integrals::at(const std::vector<double>& mus, const std::vector<double>& alphas) const {
  const std::vector<size_t> columns = places(mus_, mus);
  const std::vector<size_t> grazing = places(mus_, {grazing_mu});
  Grid grid;
  grid.terms.reserve(mus.size() * alphas.size());
  grid.grazing.reserve(alphas.size());
  for (const size_t row : places(alphas_, alphas)) {
    const Terms* terms = &terms_[row * mus_.size()];
    for (const size_t column : columns) grid.terms.push_back(terms[column]);
    grid.grazing.push_back(terms[grazing[0]]);
  }
  return grid;
}

Terms mirror_terms(double mu) {
  const double bias = std::pow(1 - std::clamp(mu, 0.0, 1.0), 5);
  return {1 - bias, bias};
}

}  // namespace kiln::validate

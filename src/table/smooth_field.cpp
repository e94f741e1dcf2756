// SPDX-License-Identifier: Apache-2.0
#include "smooth_field.h"

#include <algorithm>
#include <cmath>

#include "kiln/math/wide.h"
#include "kiln/parallel/rows.h"

namespace kiln {
namespace {

double angle_of(int k, int count) { return pi * (k + 0.5) / count; }

// rows x nodes, the weights of each of the values.
std::vector<double> all_weights(const LogAxis& axis, std::span<const double> values) {
  std::vector<double> matrix(values.size() * axis.count);
  for (size_t i = 0; i < values.size(); ++i) {
    const std::vector<double> weights = axis.weights(values[i]);
    for (int k = 0; k < axis.count; ++k) matrix[k * values.size() + i] = weights[k];
  }
  return matrix;
}

// out[i] = sum over k of factor[k] * columns[k][i]
void combine(std::span<const double> factors, std::span<const double> columns,
             std::vector<double>& out) {
  std::fill(out.begin(), out.end(), 0.0);
  for (size_t k = 0; k < factors.size(); ++k) {
    const double factor = factors[k];
    const double* column = &columns[k * out.size()];
    for (size_t i = 0; i < out.size(); ++i) out[i] = fma(factor, column[i], out[i]);
  }
}

}  // namespace

double LogAxis::node(int k) const {
  const double middle = 0.5 * std::log(low * high), half = 0.5 * std::log(high / low);
  return std::exp(middle - half * std::cos(angle_of(k, count)));
}

std::vector<double> LogAxis::weights(double x) const {
  const double middle = 0.5 * std::log(low * high), half = 0.5 * std::log(high / low);
  const double at = half > 0 ? (std::log(std::clamp(x, low, high)) - middle) / half : 0;
  std::vector<double> weights(count);
  double sum = 0;
  for (int k = 0; k < count; ++k) {
    const double distance = at + std::cos(angle_of(k, count));
    if (std::abs(distance) < 1e-15) {
      std::fill(weights.begin(), weights.end(), 0.0);
      weights[k] = 1;
      return weights;
    }
    weights[k] = (k % 2 == 0 ? 1 : -1) * std::sin(angle_of(k, count)) / distance;
    sum += weights[k];
  }
  for (double& weight : weights) weight /= sum;
  return weights;
}

SmoothField::SmoothField(LogAxis mu, LogAxis alpha, const Source& source) : mu_(mu), alpha_(alpha) {
  for (auto& plane : nodes_) plane.resize(static_cast<size_t>(mu.count) * alpha.count);
  std::vector<double> alphas;
  alphas.reserve(alpha.count);
  for (int j = 0; j < alpha.count; ++j) alphas.push_back(alpha.node(j));
  for_rows(mu.count, [&](int i) {
    const std::vector<LobeTerms> column = source(mu.node(i), alphas);
    for (int j = 0; j < alpha.count; ++j) {
      const size_t at = static_cast<size_t>(j) * mu.count + i;
      nodes_[0][at] = std::log(std::max(column[j].scale, 1e-300));
      nodes_[1][at] = column[j].bias;
      nodes_[2][at] = column[j].edge;
    }
  });
}

std::vector<LobeTerms> SmoothField::grid(std::span<const double> mus,
                                         std::span<const double> alphas) const {
  const std::vector<double> across = all_weights(mu_, mus);
  std::vector<LobeTerms> terms(mus.size() * alphas.size());
  for_rows(static_cast<int>(alphas.size()), [&](int j) {
    const std::vector<double> down = alpha_.weights(alphas[j]);
    std::array<std::vector<double>, 3> row;
    std::vector<double> nodes(mu_.count);
    for (int sum = 0; sum < 3; ++sum) {
      row[sum].resize(mus.size());
      combine(down, nodes_[sum], nodes);
      combine(nodes, across, row[sum]);
    }
    LobeTerms* out = &terms[j * mus.size()];
    for (size_t i = 0; i < mus.size(); ++i) {
      out[i] = {std::exp(row[0][i]), std::max(row[1][i], 0.0), std::max(row[2][i], 0.0)};
    }
  });
  return terms;
}

}  // namespace kiln

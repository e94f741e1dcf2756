// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "kiln/image/number_array.h"
#include "kiln/table/lobe.h"
#include "kiln/validate/verify.h"

namespace kiln::test {

using Terms = SplitSumTerms<double>;

/// How to make a table whose convention is known.
struct Recipe {
  int width = 32, height = 32;
  Lobe lobe{};
  std::function<std::vector<double>(const Terms&)> channels = [](const Terms& terms) {
    return std::vector{terms.scale, terms.bias};
  };
  std::function<double(double)> mu = [](double u) { return u; };
  std::function<double(double)> alpha = [](double u) { return u * u; };
  bool transposed = false, columns_reversed = false, rows_reversed = false;
  bool nodes = false;
  double column_shift = 0, row_shift = 0;  ///< entries
};

/// Positions along an axis of n entries.
inline std::vector<double> places(int n, bool reversed, bool nodes, double shift) {
  std::vector<double> found(n);
  for (int k = 0; k < n; ++k) {
    const int i = reversed ? n - 1 - k : k;
    const double u = nodes ? (i + shift) / (n - 1) : (i + 0.5 + shift) / n;
    found[k] = std::clamp(u, 0.0, 1.0);
  }
  return found;
}

/// The table as an image of floats.
inline NumberArray make_table(const Recipe& recipe) {
  std::vector<double> columns =
      places(recipe.width, recipe.columns_reversed, recipe.nodes, recipe.column_shift);
  std::vector<double> rows =
      places(recipe.height, recipe.rows_reversed, recipe.nodes, recipe.row_shift);
  std::vector<double>& mus = recipe.transposed ? rows : columns;
  std::vector<double>& alphas = recipe.transposed ? columns : rows;
  for (double& u : mus) u = std::max(recipe.mu(u), 1e-4);
  for (double& u : alphas) u = std::max(recipe.alpha(u), 1e-4);
  const std::vector<Terms> terms = integrate_grid(recipe.lobe, mus, alphas, Quality::Table);
  NumberArray array;
  for (int y = 0; y < recipe.height; ++y) {
    for (int x = 0; x < recipe.width; ++x) {
      const size_t i = recipe.transposed ? x : y, j = recipe.transposed ? y : x;
      for (const double value : recipe.channels(terms[i * mus.size() + j])) {
        array.values.push_back(static_cast<float>(value));
      }
    }
  }
  const int channels = static_cast<int>(recipe.channels({0, 0}).size());
  array.shape = {recipe.height, recipe.width, channels};
  return array;
}

/// All that a failing test wants to know.
inline std::string summary(const Verdict& verdict) {
  std::string text = verdict.best.convention + " | max " + std::to_string(verdict.best.max_error) +
                     " rms " + std::to_string(verdict.best.rms_error) + " ratio " +
                     std::to_string(verdict.ratio);
  for (const std::string& statement : verdict.statements) text += "\n  " + statement;
  return text;
}

}  // namespace kiln::test

// SPDX-License-Identifier: Apache-2.0
#include "ltc_reading.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "axes.h"
#include "fit.h"
#include "kiln/parallel/rows.h"
#include "kiln/table/ltc.h"
#include "statements.h"

namespace kiln::validate {
namespace {

constexpr int entries_tried = 3, entries_compared = 6, entries_measured = 20;
constexpr double greatest_share = 0.1;  // of light that goes elsewhere, mean over the table
constexpr double hopeless = 0.4;        // at one entry
constexpr double clear_ratio = 1.5;
constexpr double least_cosine = 8e-4;  // where published tables end: an angle of 1.57

// Channels of m11, m31, m13, m33; by columns as published, or by rows.
using Order = std::array<int, 4>;
constexpr Order by_columns{0, 1, 2, 3}, by_rows{0, 2, 1, 3};

struct Reading {
  TableAxes axes;
  Order order = by_columns;
};

// Shares of light that the cells send elsewhere, [alpha][mu].
struct Shares {
  Places places;
  std::vector<double> mus, alphas, values;
  double mean = 1;
};

Shares shares_of(const Sheet& sheet, const Reading& reading, Places places) {
  Shares shares;
  shares.places = std::move(places);
  const Values values = values_of(sheet, reading.axes.transposed, shares.places);
  shares.mus = cosines_of(sheet, reading.axes, shares.places);
  shares.alphas = alphas_of(sheet, reading.axes, shares.places);
  const size_t count = shares.mus.size();
  shares.values.resize(count * shares.alphas.size());
  const LtcLobe lobe = ggx_ltc_lobe();
  for_rows(static_cast<int>(shares.alphas.size()), [&](int j) {
    for (size_t i = 0; i < count; ++i) {
      const size_t at = j * count + i;
      const auto number = [&](int k) { return values[reading.order[k]][at]; };
      const LtcCell cell{number(0), number(1), number(2), number(3), 0};
      const double mu = std::max(shares.mus[i], least_cosine);
      const double share = cell.determinant() > 0
                               ? measure_ltc(cell, mu, std::max(shares.alphas[j], 1e-4), lobe).l1
                               : 1;
      shares.values[at] = std::isfinite(share) ? std::min(share, 1.0) : 1;
    }
  });
  double sum = 0;
  for (const double share : shares.values) sum += share;
  shares.mean = sum / static_cast<double>(shares.values.size());
  return shares;
}

// Entries off the borders, where fits are worst and say least.
std::vector<int> inner_indices(int n, int most) {
  std::vector<int> indices;
  indices.reserve(most);
  const int count = std::min(n, most);
  for (int k = 0; k < count; ++k) indices.push_back((2 * k + 1) * n / (2 * count));
  return indices;
}

Shares inner_shares(const Sheet& sheet, const Reading& reading, int most) {
  const std::vector<int> x = inner_indices(sheet.size().width, most);
  const std::vector<int> y = inner_indices(sheet.size().height, most);
  return reading.axes.transposed ? shares_of(sheet, reading, Places{y, x})
                                 : shares_of(sheet, reading, Places{x, y});
}

// Of one entry, a third of the way along x and two thirds along y: nothing is symmetric there.
Shares share_of_one(const Sheet& sheet, const Reading& reading) {
  const std::vector<int> x{sheet.size().width / 3}, y{2 * sheet.size().height / 3};
  return reading.axes.transposed ? shares_of(sheet, reading, Places{y, x})
                                 : shares_of(sheet, reading, Places{x, y});
}

TableAxes cosine_axes(CosineAxis map, bool reversed, const Placement& alignment) {
  return {.transposed = true,
          .cosine = map,
          .cosine_reversed = reversed,
          .cosine_alignment = alignment,
          .width_alignment = alignment};
}

// sqrt(1 - n.v), n.v both ways; widths as roughness or alpha; x and y exchanged; by columns and
// rows.
std::vector<Reading> all_readings() {
  std::vector<Reading> all;
  for (const Placement& alignment : {nodes, centres}) {
    for (const auto& [map, reversed] : {std::pair{CosineAxis::OneMinusRoot, true},
                                        {CosineAxis::OneMinusRoot, false},
                                        {CosineAxis::Cosine, false},
                                        {CosineAxis::Cosine, true}}) {
      for (const WidthAxis width : {WidthAxis::Roughness, WidthAxis::Alpha}) {
        for (unsigned bits = 0; bits < 8; ++bits) {
          TableAxes axes = cosine_axes(map, reversed, alignment);
          axes.transposed = (bits & 1) == 0;
          axes.width = width;
          axes.width_reversed = (bits & 2) != 0;
          all.push_back({axes, (bits & 4) == 0 ? by_columns : by_rows});
        }
      }
    }
  }
  return all;
}

// A determinant of varied sign, or values below 0 on the diagonal, make no lobe.
bool may_be_matrices(const Sheet& sheet) {
  if (sheet.channels.size() != 4 || sheet.is_curve() || sheet.arrangement.depth > 1) return false;
  const Values values = values_of(sheet, false, spread_places(sheet, false, 16));
  const auto positive = [&](int c) {
    return std::count_if(values[c].begin(), values[c].end(), [](double v) { return v > 0; }) >=
           static_cast<long>(0.95 * static_cast<double>(values[c].size()));
  };
  return positive(0) && positive(3) && variance(values[0]) > 1e-6 && variance(values[3]) > 1e-6;
}

struct Ranked {
  Reading reading;
  double mean = 1;
};

template <class Measure>
void keep_best(std::vector<Ranked>& all, size_t most, Measure&& measure) {
  for (Ranked& one : all) one.mean = measure(one.reading).mean;
  std::stable_sort(all.begin(), all.end(),
                   [](const Ranked& a, const Ranked& b) { return a.mean < b.mean; });
  all.resize(std::min(all.size(), most));
}

// Best first, after closer and closer looks at fewer and fewer.
std::vector<Ranked> rank(const Sheet& sheet) {
  std::vector<Ranked> all;
  for (const Reading& reading : all_readings()) all.push_back({reading, 1});
  keep_best(all, 16, [&](const Reading& reading) { return share_of_one(sheet, reading); });
  if (all[0].mean > hopeless) return all;
  for (const auto& look : {std::pair{6, entries_tried}, std::pair{4, entries_compared}}) {
    keep_best(all, look.first,
              [&](const Reading& reading) { return inner_shares(sheet, reading, look.second); });
    if (all[0].mean > 2 * greatest_share) break;
  }
  return all;
}

Match describe(const Sheet& sheet, const Reading& reading, const Shares& shares) {
  Match match;
  match.array = sheet.array->name;
  match.arrangement = sheet.arrangement.words;
  match.decoding = sheet.decoding.words;
  match.table_class = "ltc";
  match.axes = reading.axes;
  double squares = 0;
  const size_t count = shares.mus.size();
  for (size_t k = 0; k < shares.values.size(); ++k) {
    squares += shares.values[k] * shares.values[k];
    if (k > 0 && shares.values[k] <= match.max_error) continue;
    const size_t i = k % count, j = k / count;
    match.max_error = shares.values[k];
    match.mu = shares.mus[i];
    match.roughness = std::sqrt(shares.alphas[j]);
    match.x = reading.axes.transposed ? shares.places.widths[j] : shares.places.cosines[i];
    match.y = reading.axes.transposed ? shares.places.cosines[i] : shares.places.widths[j];
  }
  match.rms_error = std::sqrt(squares / static_cast<double>(shares.values.size()));
  constexpr const char* names[] = {"m11", "m31", "m13", "m33"};
  std::string contents;
  for (int c = 0; c < 4; ++c) {
    const char* name = names[reading.order[c]];
    match.channels.push_back({sheet.channels[c], name, "ggx", "smith-correlated", match.max_error,
                              match.rms_error, true, false});
    contents += fmt::format("{}{} = {}", c == 0 ? "" : ", ", sheet.channels[c], name);
  }
  match.channel = sheet.channels[0];
  match.convention = fmt::format(
      "{} of the inverse matrices of linearly transformed cosines for ggx with "
      "smith-correlated masking; {}; {}",
      contents, words(reading.axes), match.decoding);
  return match;
}

// The share of light that goes elsewhere, the same for all channels: one plane.
Layers share_layers(const Reading& reading, const Shares& shares) {
  const int count = static_cast<int>(shares.mus.size());
  const int rows = static_cast<int>(shares.alphas.size());
  const bool transposed = reading.axes.transposed;
  Layers layers{transposed ? Size{rows, count} : Size{count, rows}, {}};
  Plane& plane = layers.add("error.share");
  for (int k = 0; k < count * rows; ++k) {
    const int i = k % count, j = k / count;
    plane.at(transposed ? j : i, transposed ? i : j) = static_cast<float>(shares.values[k]);
  }
  return layers;
}

Verdict judge(const Sheet& sheet) {
  Verdict verdict;
  const std::vector<Ranked> ranked = rank(sheet);
  if (ranked[0].mean > 1.5 * greatest_share) return verdict;
  const Reading& best = ranked[0].reading;
  const Shares shares = inner_shares(sheet, best, entries_measured);
  verdict.best = describe(sheet, best, shares);
  verdict.ratio = ranked[1].mean / std::max(ranked[0].mean, 1e-9);
  verdict.fits = shares.mean < greatest_share && verdict.ratio >= clear_ratio;
  if (!verdict.fits) return verdict;
  verdict.runner_up =
      describe(sheet, ranked[1].reading, inner_shares(sheet, ranked[1].reading, entries_compared));
  verdict.errors = share_layers(best, shares);
  verdict.statements.push_back(
      fmt::format("errors are shares of light that the lobes send elsewhere: {:.2g} on average, "
                  "{:.2g} at most",
                  shares.mean, verdict.best.max_error));
  if (best.axes == cosine_axes(CosineAxis::OneMinusRoot, true, nodes) && best.order == by_columns) {
    verdict.presets.push_back("ltc");
  }
  return verdict;
}

}  // namespace

Verdict verify_cosines(const std::vector<Sheet>& sheets) {
  for (const Sheet& sheet : sheets) {
    if (!may_be_matrices(sheet)) continue;
    Verdict verdict = judge(sheet);
    if (verdict.fits) return verdict;
  }
  return {};
}

}  // namespace kiln::validate

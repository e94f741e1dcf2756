// SPDX-License-Identifier: Apache-2.0
#include "search.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace kiln::validate {
namespace {

constexpr int coarse_entries = 12, fine_entries = 16;
constexpr size_t kept_per_sheet = 16, most_settled = 8;

// Curves hold averages over directions, tables the integrals themselves.
Grid quick_grid(const Sheet& sheet, int lobe, const Reading& reading) {
  const Field& field = field_of(lobe);
  return sheet.is_curve() ? field.averages(reading.alphas)
                          : field.grid(reading.mus, reading.alphas);
}

Grid exact_of(const Sheet& sheet, int lobe, const Reading& reading) {
  const Lobe& names = tried_lobes()[lobe].lobe;
  return sheet.is_curve() ? exact_averages(names, reading.alphas)
                          : exact_grid(names, reading.mus, reading.alphas);
}

// Curves have one axis.
bool fits_shape(const Sheet& sheet, const TableAxes& axes) {
  return !sheet.is_curve() ||
         (axes.transposed && axes.cosine == CosineAxis::Cosine && !axes.cosine_reversed);
}

// The best candidate of each class so far.
class Ranking {
 public:
  void add(Candidate candidate) {
    const std::string key = class_of(candidate);
    const auto found = best_.find(key);
    if (found == best_.end()) {
      best_.emplace(key, std::move(candidate));
    } else if (handicapped(candidate) < handicapped(found->second)) {
      found->second = std::move(candidate);
    }
  }

  std::vector<Candidate> first(size_t most) const {
    std::vector<Candidate> ranked;
    ranked.reserve(best_.size());
    for (const auto& [key, candidate] : best_) ranked.push_back(candidate);
    std::stable_sort(ranked.begin(), ranked.end(), [](const Candidate& a, const Candidate& b) {
      return handicapped(a) < handicapped(b);
    });
    if (ranked.size() > most) ranked.resize(most);
    return ranked;
  }

 private:
  std::map<std::string, Candidate> best_;
};

// All lobes under these axes.
void fit_lobes(const Sheet& sheet, int index, const TableAxes& axes, const Reading& reading,
               const std::vector<int>& lobes, Ranking& ranking) {
  std::vector<ChannelFit> shared = constant_channels(reading.values);
  if (!sheet.is_curve()) improve_fits(reading, -1, {}, meanings_without_lobe(), shared);
  for (const int lobe : lobes) {
    if (!tried_lobes()[lobe].sheen) continue;
    improve_fits(reading, lobe, quick_grid(sheet, lobe, reading), meanings_of_sheen(), shared);
  }
  for (const int lobe : lobes) {
    if (tried_lobes()[lobe].sheen) continue;
    std::vector<ChannelFit> fits = shared;
    improve_fits(reading, lobe, quick_grid(sheet, lobe, reading), meanings_of_specular(), fits);
    const double score = score_of(fits);
    ranking.add({index, axes, std::move(fits), score});
  }
}

std::vector<int> lobes_for(Effort effort) {
  std::vector<int> lobes;
  for (size_t k = 0; k < tried_lobes().size(); ++k) {
    if (effort == Effort::AllLobes || !tried_lobes()[k].rare) lobes.push_back(static_cast<int>(k));
  }
  return lobes;
}

bool varies(const Values& values) {
  const std::vector<ChannelFit> fits = constant_channels(values);
  return std::any_of(fits.begin(), fits.end(), [](const ChannelFit& fit) { return !fit.constant; });
}

void search_sheet(const Sheet& sheet, int index, const std::vector<int>& lobes, Ranking& ranking) {
  for (const bool transposed : {false, true}) {
    if (sheet.is_curve() && !transposed) continue;
    const Places places = spread_places(sheet, transposed, coarse_entries);
    Reading reading = reading_of(sheet, transposed, places);
    if (!varies(reading.values)) return;
    for (TableAxes axes : all_axes()) {
      if (axes.transposed != transposed || !fits_shape(sheet, axes)) continue;
      for (const Placement& alignment : {centres, nodes}) {
        axes.cosine_alignment = axes.width_alignment = alignment;
        reading.mus = cosines_of(sheet, axes, places);
        reading.alphas = alphas_of(sheet, axes, places);
        fit_lobes(sheet, index, axes, reading, lobes, ranking);
      }
    }
  }
}

// Models that the channels are of.
std::set<int> models_of(const Candidate& candidate) {
  std::set<int> used;
  for (const ChannelFit& fit : candidate.fits) {
    if (fit.model >= 0 && !fit.constant) used.insert(fit.model);
  }
  return used;
}

// The same meanings at other places: fits with their errors there.
std::vector<ChannelFit> refit(const Sheet& sheet, const Reading& reading,
                              const Candidate& candidate) {
  std::vector<ChannelFit> fits = candidate.fits;
  std::map<int, Grid> grids;
  grids[-1] = {};
  for (const int lobe : models_of(candidate)) grids[lobe] = quick_grid(sheet, lobe, reading);
  for (size_t c = 0; c < fits.size(); ++c) {
    if (fits[c].constant) continue;
    std::vector<ChannelFit> one(1);
    const Reading channel{{reading.values[c]}, reading.mus, reading.alphas, reading.ceiling};
    improve_fits(channel, fits[c].model, grids[fits[c].model], {&fits[c].meaning, 1}, one);
    fits[c] = one[0];
  }
  return fits;
}

std::vector<TableAxes> with_alignments(const TableAxes& axes, bool of_cosines) {
  std::vector<TableAxes> all;
  for (const Placement& alignment : all_alignments()) {
    all.push_back(axes);
    (of_cosines ? all.back().cosine_alignment : all.back().width_alignment) = alignment;
  }
  return all;
}

// The candidate under all alignments of one axis.
std::vector<Candidate> aligned(const Sheet& sheet, const Candidate& candidate, const Places& places,
                               Reading& reading, bool of_cosines) {
  std::vector<Candidate> all;
  for (const TableAxes& axes : with_alignments(candidate.axes, of_cosines)) {
    reading.mus = cosines_of(sheet, axes, places);
    reading.alphas = alphas_of(sheet, axes, places);
    Candidate one = candidate;
    one.axes = axes;
    one.fits = refit(sheet, reading, candidate);
    one.score = score_of(one.fits);
    all.push_back(std::move(one));
  }
  return all;
}

Candidate best_of(std::vector<Candidate> all) {
  return *std::min_element(all.begin(), all.end(), [](const Candidate& a, const Candidate& b) {
    return handicapped(a) < handicapped(b);
  });
}

}  // namespace

std::string class_of(const Candidate& candidate) {
  const TableAxes& axes = candidate.axes;
  std::string key =
      fmt::format("{} {}{}{} {} {}", candidate.sheet, axes.transposed, axes.cosine_reversed,
                  axes.width_reversed, static_cast<int>(axes.cosine), static_cast<int>(axes.width));
  for (const ChannelFit& fit : candidate.fits) {
    key += fit.constant ? " -" : fmt::format(" {}.{}", fit.model, static_cast<int>(fit.meaning));
  }
  return key;
}

double handicapped(const Candidate& candidate) {
  const TableAxes& axes = candidate.axes;
  int oddness = 0;
  if (!plain(axes.cosine_alignment)) ++oddness;
  if (!plain(axes.width_alignment)) ++oddness;
  if (axes.cosine_alignment != axes.width_alignment) ++oddness;
  if (axes.width == WidthAxis::FourthRoot) ++oddness;
  double least = candidate.score;
  for (const ChannelFit& fit : candidate.fits) {
    if (!fit.constant) least = std::min(least, fit.rms);
  }
  return candidate.score + oddness * (0.01 * least + 1e-9);
}

Candidate align(const Sheet& sheet, const Candidate& candidate, int entries) {
  const Places places = spread_places(sheet, candidate.axes.transposed, entries);
  Reading reading = reading_of(sheet, candidate.axes.transposed, places);
  Candidate best = candidate;
  for (int pass = 0; pass < 2; ++pass) {
    const TableAxes before = best.axes;
    best = best_of(aligned(sheet, best, places, reading, false));
    if (!sheet.is_curve()) best = best_of(aligned(sheet, best, places, reading, true));
    if (best.axes == before) break;
  }
  return best;
}

// The best of the candidate and those a step of one axis away, by exact integrals.
static Candidate one_step(const Sheet& sheet, const Candidate& candidate, int entries) {
  const Places places = spread_places(sheet, candidate.axes.transposed, entries);
  Reading reading = reading_of(sheet, candidate.axes.transposed, places);
  std::vector<Candidate> near = aligned(sheet, candidate, places, reading, false);
  if (!sheet.is_curve()) {
    for (Candidate& one : aligned(sheet, candidate, places, reading, true)) {
      near.push_back(std::move(one));
    }
  }
  std::stable_sort(near.begin(), near.end(), [](const Candidate& a, const Candidate& b) {
    return handicapped(a) < handicapped(b);
  });
  Candidate best = candidate;
  best.score = 1e9;
  for (size_t k = 0; k < std::min<size_t>(near.size(), most_settled); ++k) {
    Candidate one = near[k];
    one.fits = compare(sheet, one, entries).fits;
    one.score = score_of(one.fits);
    if (handicapped(one) < handicapped(best)) best = std::move(one);
  }
  return best;
}

Candidate settle(const Sheet& sheet, const Candidate& candidate, int entries) {
  Candidate best = one_step(sheet, candidate, entries);
  for (int steps = 1; steps < 3 && !(best.axes == candidate.axes); ++steps) {
    Candidate next = one_step(sheet, best, entries);
    if (next.axes == best.axes) break;
    best = std::move(next);
  }
  return best;
}

std::vector<Candidate> search(const std::vector<Sheet>& sheets, Effort effort) {
  const std::vector<int> lobes = lobes_for(effort);
  Ranking refined;
  for (size_t i = 0; i < sheets.size(); ++i) {
    Ranking coarse;
    search_sheet(sheets[i], static_cast<int>(i), lobes, coarse);
    const std::vector<Candidate> kept = coarse.first(kept_per_sheet);
    for (size_t k = 0; k < kept.size(); ++k) {
      if (k >= 4 && kept[k].score > 3 * kept[0].score + 0.01) break;
      refined.add(align(sheets[i], kept[k], fine_entries));
    }
  }
  return refined.first(sheets.size() * kept_per_sheet);
}

Comparison compare(const Sheet& sheet, const Candidate& candidate, int most) {
  Comparison result;
  result.places = spread_places(sheet, candidate.axes.transposed, most);
  Reading& reading = result.reading;
  reading = reading_of(sheet, candidate.axes.transposed, result.places);
  reading.mus = cosines_of(sheet, candidate.axes, result.places);
  reading.alphas = alphas_of(sheet, candidate.axes, result.places);
  std::map<int, Grid> grids;
  grids[-1] = {};
  for (const int k : models_of(candidate)) {
    grids[k] = exact_of(sheet, k, reading);
  }
  result.fits = candidate.fits;
  for (size_t c = 0; c < result.fits.size(); ++c) {
    ChannelFit& fit = result.fits[c];
    result.exact.push_back(
        exact_entries(fit, reading, static_cast<int>(c), grids[fit.constant ? -1 : fit.model]));
    double sum = 0;
    for (size_t i = 0; i < result.exact[c].size(); ++i) {
      const double error = reading.values[c][i] - result.exact[c][i];
      sum += error * error;
    }
    fit.rms = std::sqrt(sum / static_cast<double>(result.exact[c].size()));
  }
  return result;
}

}  // namespace kiln::validate

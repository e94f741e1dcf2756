// SPDX-License-Identifier: Apache-2.0
#include "kind_search.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace kiln::validate {
namespace {

constexpr int coarse_plane = 7, coarse_solid = 4;
constexpr double greatest_share = 0.1;
constexpr double exact_score = 1e-6;  // below it readings are alike, and the first one counts

// The entries of a sheet that are looked at, [channel][z][y][x].
struct Sample {
  std::vector<int> counts;               // of all entries along x, y, z
  std::vector<std::vector<int>> places;  // of those looked at
  Values values;
};

Sample sample_of(const Sheet& sheet, int most) {
  const int depth = sheet.arrangement.depth, height = sheet.size().height / depth;
  Sample sample{{sheet.size().width, height}, {}, {}};
  if (depth > 1) sample.counts.push_back(depth);
  for (const int count : sample.counts) sample.places.push_back(spread_indices(count, most));
  std::vector<int> rows;
  const std::vector<int> slices = depth > 1 ? sample.places[2] : std::vector<int>{0};
  for (const int z : slices) {
    for (const int y : sample.places[1]) rows.push_back(z * height + y);
  }
  sample.values = values_at(sheet, sample.places[0], rows);
  return sample;
}

double coordinate_at(const AxisMapping& mapping, int place, int count, Alignment alignment) {
  return mapping.value(entry_position(place, count, alignment));
}

// Of the kind's quantities, as if no axis were reversed: places are symmetric about the middle.
Coordinates coordinates_of(const Sample& sample, const KindReading& reading) {
  Coordinates coordinates(reading.order.size());
  for (size_t a = 0; a < reading.order.size(); ++a) {
    const int q = reading.order[a];
    for (const int place : sample.places[a]) {
      coordinates[q].push_back(
          coordinate_at(*reading.mappings[q], place, sample.counts[a], reading.alignment));
    }
  }
  return coordinates;
}

// Where entries of the sample stand among filled ones, and whether a kind's limit may stand there.
struct Seat {
  size_t at = 0;
  bool at_limit = false;
};

std::vector<Seat> seats_of(const Sample& sample, const KindReading& reading) {
  const size_t axes = reading.order.size();
  std::vector<size_t> steps(axes);
  size_t step = 1;
  for (size_t q = 0; q < axes; ++q) {
    const size_t a = std::find(reading.order.begin(), reading.order.end(), static_cast<int>(q)) -
                     reading.order.begin();
    steps[a] = step;
    step *= sample.places[a].size();
  }
  std::vector<bool> ends;  // whether an axis ends in a limit
  for (const int q : reading.order) {
    ends.push_back(
        reading.alignment == Alignment::Corner &&
        (q + 1 == static_cast<int>(axes) || reading.mappings[q]->quantity == Quantity::Roughness));
  }
  std::vector<Seat> seats(step);
  for (size_t i = 0; i < step; ++i) {
    size_t rest = i;
    for (size_t a = 0; a < axes; ++a) {
      const size_t n = sample.places[a].size(), k = rest % n;
      const size_t from_least = reading.reversed[a] ? n - 1 - k : k;
      seats[i].at += from_least * steps[a];
      if (from_least == 0 && ends[a]) seats[i].at_limit = true;
      rest /= n;
    }
  }
  return seats;
}

// Filled values as the sample has them.
std::vector<double> seated(const std::vector<double>& filled, const std::vector<Seat>& seats,
                           const std::optional<double>& limit, const std::vector<double>& stored) {
  std::vector<double> values(seats.size());
  for (size_t i = 0; i < seats.size(); ++i) {
    values[i] = filled[seats[i].at];
    if (!limit || !seats[i].at_limit) continue;
    if (std::abs(*limit - stored[i]) < std::abs(values[i] - stored[i])) values[i] = *limit;
  }
  return values;
}

double rms_between(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum / static_cast<double>(a.size()));
}

std::vector<KindFit> constant_fits(const Values& values) {
  std::vector<KindFit> fits(values.size());
  for (size_t c = 0; c < values.size(); ++c) {
    const auto [least, greatest] = std::minmax_element(values[c].begin(), values[c].end());
    if (*greatest - *least > 1e-6) continue;
    fits[c] = {-1, true, *least, 0};
  }
  return fits;
}

double score_of(const std::vector<KindFit>& fits) {
  double sum = 0;
  int count = 0;
  for (const KindFit& fit : fits) {
    if (fit.constant) continue;
    sum += std::min(fit.rms, greatest_share);
    ++count;
  }
  return count == 0 ? greatest_share : sum / count;
}

// Every choice of one mapping for each quantity, the kind's own first.
std::vector<std::vector<const AxisMapping*>> all_mappings(const Kind& kind) {
  std::vector<std::vector<const AxisMapping*>> all{{}};
  for (const auto& axis : kind.axes) {
    std::vector<std::vector<const AxisMapping*>> longer;
    for (const auto& chosen : all) {
      for (const AxisMapping* mapping : axis) {
        longer.push_back(chosen);
        longer.back().push_back(mapping);
      }
    }
    all = std::move(longer);
  }
  return all;
}

// The least errors of the channels under this reading.
KindCandidate fitted(const Sample& sample, const KindReading& reading,
                     const std::vector<std::vector<double>>& filled) {
  const Kind& kind = all_kinds()[reading.kind];
  const std::vector<Seat> seats = seats_of(sample, reading);
  KindCandidate candidate{0, reading, constant_fits(sample.values), 1};
  for (size_t c = 0; c < sample.values.size(); ++c) {
    KindFit& fit = candidate.fits[c];
    if (fit.constant) continue;
    for (size_t k = 0; k < filled.size(); ++k) {
      const double rms =
          rms_between(seated(filled[k], seats, kind.limit, sample.values[c]), sample.values[c]);
      if (rms < fit.rms) fit = {static_cast<int>(k), false, 0, rms};
    }
  }
  candidate.score = score_of(candidate.fits);
  return candidate;
}

// Flips and, where x and y have one length, their exchange read the same values again.
void try_orders(const Sample& sample, KindReading reading, std::vector<KindCandidate>& found) {
  const Kind& kind = all_kinds()[reading.kind];
  std::vector<int> all(kind.contents.size());
  std::iota(all.begin(), all.end(), 0);
  std::vector<std::vector<double>> filled;
  for (const bool transposed : {false, true}) {
    reading.order.resize(kind.axes.size());
    std::iota(reading.order.begin(), reading.order.end(), 0);
    if (transposed) std::swap(reading.order[0], reading.order[1]);
    if (!transposed || sample.counts[0] != sample.counts[1]) {
      filled = fill_contents(kind, coordinates_of(sample, reading), all);
    }
    for (unsigned flips = 0; flips < 1u << kind.axes.size(); ++flips) {
      reading.reversed.clear();
      for (size_t a = 0; a < kind.axes.size(); ++a)
        reading.reversed.push_back((flips >> a & 1) != 0);
      found.push_back(fitted(sample, reading, filled));
    }
  }
}

std::vector<KindCandidate> search_sheet(const Sheet& sheet) {
  const bool solid = sheet.arrangement.depth > 1;
  const Sample sample = sample_of(sheet, solid ? coarse_solid : coarse_plane);
  std::vector<KindCandidate> found;
  for (size_t k = 0; k < all_kinds().size(); ++k) {
    const Kind& kind = all_kinds()[k];
    if (kind.axes.size() != sample.counts.size()) continue;
    for (const auto& chosen : all_mappings(kind)) {
      for (const Alignment alignment : {Alignment::Center, Alignment::Corner}) {
        try_orders(sample, {static_cast<int>(k), chosen, {}, {}, alignment}, found);
      }
    }
  }
  return found;
}

}  // namespace

std::vector<KindCandidate> search_kinds(const std::vector<Sheet>& sheets) {
  std::vector<KindCandidate> all;
  for (size_t i = 0; i < sheets.size(); ++i) {
    if (sheets[i].is_curve()) continue;
    for (KindCandidate& one : search_sheet(sheets[i])) {
      one.sheet = static_cast<int>(i);
      all.push_back(std::move(one));
    }
  }
  std::stable_sort(all.begin(), all.end(), [](const KindCandidate& a, const KindCandidate& b) {
    return std::max(a.score, exact_score) < std::max(b.score, exact_score);
  });
  if (all.size() > 8) all.resize(8);
  return all;
}

KindComparison compare(const Sheet& sheet, const KindCandidate& candidate, int most) {
  const Sample sample = sample_of(sheet, most);
  const KindReading& reading = candidate.reading;
  const Kind& kind = all_kinds()[reading.kind];
  KindComparison result{sample.places, {}, sample.values, {}, candidate.fits};
  const Coordinates coordinates = coordinates_of(sample, reading);
  for (size_t a = 0; a < reading.order.size(); ++a) {
    result.coordinates.push_back(coordinates[reading.order[a]]);
    if (reading.reversed[a]) {
      std::reverse(result.coordinates[a].begin(), result.coordinates[a].end());
    }
  }
  std::vector<int> wanted;
  for (const KindFit& fit : candidate.fits) {
    if (fit.content >= 0) wanted.push_back(fit.content);
  }
  const auto filled = fill_contents(kind, coordinates, wanted);
  const std::vector<Seat> seats = seats_of(sample, reading);
  size_t next = 0;
  for (size_t c = 0; c < result.fits.size(); ++c) {
    KindFit& fit = result.fits[c];
    const std::vector<double>& stored = result.values[c];
    result.exact.push_back(fit.content < 0 ? std::vector<double>(stored.size(), fit.level)
                                           : seated(filled[next++], seats, kind.limit, stored));
    fit.rms = rms_between(stored, result.exact[c]);
  }
  return result;
}

}  // namespace kiln::validate

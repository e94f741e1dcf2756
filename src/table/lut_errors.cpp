// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "lattice.h"

namespace kiln {
namespace {

// Where a coordinate lies among the entries of an axis: the first of two, and how far to the next.
struct Between {
  int first = 0;
  double blend = 0;
};

Between place(const TableAxis& axis, Alignment alignment, double coordinate) {
  double u = axis.mapping.position(coordinate);
  if (axis.flipped) u = 1 - u;
  const double last = axis.count - 1;
  const double at =
      std::clamp(alignment == Alignment::Center ? u * axis.count - 0.5 : u * last, 0.0, last);
  const int first = std::clamp(static_cast<int>(at), 0, std::max(axis.count - 2, 0));
  return {first, at - first};
}

// Lookups at crossings of coordinates, and the entries that they read.
struct Lookups {
  LutIndices indices;                         // of the entries, along each axis
  std::vector<std::vector<Between>> between;  // among those, for each coordinate of each axis
};

Lookups lookups_at(const LutSource& source, const std::vector<std::vector<double>>& coordinates) {
  Lookups lookups;
  for (size_t a = 0; a < coordinates.size(); ++a) {
    const TableAxis& axis = source.axes()[a];
    std::vector<Between> between;
    std::vector<int> read;
    for (const double coordinate : coordinates[a]) {
      between.push_back(place(axis, source.recipe().alignment, coordinate));
      read.push_back(between.back().first);
      if (read.back() + 1 < axis.count) read.push_back(read.back() + 1);
    }
    std::sort(read.begin(), read.end());
    read.erase(std::unique(read.begin(), read.end()), read.end());
    for (Between& one : between) {
      const auto found = std::lower_bound(read.begin(), read.end(), one.first);
      one.first = static_cast<int>(found - read.begin());
    }
    lookups.indices.push_back(std::move(read));
    lookups.between.push_back(std::move(between));
  }
  return lookups;
}

// Indices along each axis of the i-th point of a lattice of lists.
template <class List>
std::vector<size_t> crossing(const std::vector<List>& axes, size_t i) {
  std::vector<size_t> at;
  for (const List& axis : axes) {
    at.push_back(i % axis.size());
    i /= axis.size();
  }
  return at;
}

double interpolated(const std::vector<double>& entries, const Lookups& lookups,
                    const std::vector<size_t>& point) {
  double sum = 0;
  for (unsigned corner = 0; corner < 1u << point.size(); ++corner) {
    double weight = 1;
    size_t index = 0, step = 1;
    for (size_t a = 0; a < point.size(); ++a) {
      const Between& at = lookups.between[a][point[a]];
      const bool next = (corner >> a & 1) != 0;
      weight *= next ? at.blend : 1 - at.blend;
      index += step * static_cast<size_t>(at.first + (next ? 1 : 0));
      step *= lookups.indices[a].size();
    }
    if (weight != 0) sum += weight * entries[index];
  }
  return sum;
}

// Up to `most` of n indices, evenly, first and last among them.
std::vector<int> spread_indices(int n, int most) {
  const int count = std::min(n, most);
  std::vector<int> indices;
  indices.reserve(count);
  for (int k = 0; k < count; ++k) {
    indices.push_back(count > 1 ? static_cast<int>(std::lround(k * (n - 1.0) / (count - 1))) : 0);
  }
  return indices;
}

void check_entries(LutSource& source, LutErrors& errors) {
  const int most = source.axes().size() > 2 ? 5 : 19;
  Lattice lattice = lattice_of(source.axes());
  LutIndices indices;
  for (size_t a = 0; a < source.axes().size(); ++a) {
    const TableAxis& axis = source.axes()[a];
    indices.push_back(spread_indices(axis.count, most));
    lattice.positions[a].clear();
    for (const int i : indices[a]) lattice.positions[a].push_back(axis.coordinates[i]);
  }
  LobeCache lobes(finer(quality_of(source.recipe())), least_mu);
  const LutEntries truth = fill_lattice(source.recipe(), lattice, lobes, Fits::Without);
  const LutEntries found = source.entries(indices);
  errors.entries_checked = static_cast<int>(lattice.count());
  for (size_t c = 0; c < truth.size(); ++c) {
    for (size_t i = 0; i < truth[c].size(); ++i) {
      errors.entry = std::max(errors.entry, std::abs(found[c][i] - truth[c][i]));
    }
  }
}

// Probes crowd toward grazing angles, where lookups err most.
std::vector<double> probes_along(const AxisMapping& mapping, int count) {
  std::vector<double> probes;
  probes.reserve(count);
  for (int i = 0; i < count; ++i) {
    const double u = (i + 0.5) / count;
    if (mapping.quantity == Quantity::Mu) {
      probes.push_back(1e-3 + (1 - 1e-3) * u * u);
    } else if (mapping.quantity == Quantity::Roughness) {
      probes.push_back(0.01 + 0.99 * i / (count - 1));
    } else {
      probes.push_back(mapping.value(u));
    }
  }
  return probes;
}

bool is_inner(const LutSource& source, const std::vector<std::vector<double>>& probes,
              const std::vector<size_t>& point) {
  for (size_t a = 0; a < point.size(); ++a) {
    const Quantity quantity = source.axes()[a].mapping.quantity;
    if (quantity == Quantity::Mu && probes[a][point[a]] < 0.05) return false;
    if (quantity == Quantity::Roughness && probes[a][point[a]] < 0.1) return false;
  }
  return true;
}

void check_lookups(LutSource& source, LutErrors& errors) {
  const int count = source.axes().size() > 2 ? 12 : 96;
  std::vector<std::vector<double>> probes;
  for (const TableAxis& axis : source.axes()) probes.push_back(probes_along(axis.mapping, count));
  const LutEntries truth = source.integrals(probes);
  const Lookups lookups = lookups_at(source, probes);
  const LutEntries entries = source.entries(lookups.indices);
  for (size_t c = 0; c < truth.size(); ++c) {
    for (size_t i = 0; i < truth[c].size(); ++i) {
      const std::vector<size_t> point = crossing(probes, i);
      const double error = std::abs(interpolated(entries[c], lookups, point) - truth[c][i]);
      errors.lookup = std::max(errors.lookup, error);
      if (is_inner(source, probes, point)) {
        errors.lookup_inner = std::max(errors.lookup_inner, error);
      }
    }
  }
}

}  // namespace

LutErrors errors_of(LutSource& source) {
  LutErrors errors;
  errors.fit = source.fit_error();
  check_entries(source, errors);
  check_lookups(source, errors);
  return errors;
}

std::vector<double> look_up(LutSource& source, const std::vector<double>& point) {
  std::vector<std::vector<double>> coordinates;
  coordinates.reserve(point.size());
  for (const double coordinate : point) coordinates.push_back({coordinate});
  const Lookups lookups = lookups_at(source, coordinates);
  std::vector<double> values;
  for (const auto& channel : source.entries(lookups.indices)) {
    values.push_back(interpolated(channel, lookups, std::vector<size_t>(point.size(), 0)));
  }
  return values;
}

}  // namespace kiln

// SPDX-License-Identifier: Apache-2.0
#include "coordinate_grid.h"

#include <algorithm>
#include <cmath>

namespace kiln::io {
namespace {

// The place of every row along one coordinate.
struct Coordinate {
  std::vector<size_t> place;
  size_t length = 0;
  bool one_way = false;  // values first occur ascending or descending
};

std::vector<double> distinct(const std::vector<double>& numbers, size_t columns, size_t column) {
  std::vector<double> values;
  values.reserve(numbers.size() / columns);
  for (size_t at = column; at < numbers.size(); at += columns) values.push_back(numbers[at]);
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

Coordinate coordinate_of(const std::vector<double>& numbers, size_t columns, size_t column) {
  const std::vector<double> values = distinct(numbers, columns, column);
  Coordinate result;
  result.length = values.size();
  result.place.reserve(numbers.size() / columns);
  std::vector<bool> seen(values.size(), false);
  size_t rising = 0, falling = 0;  // how many first occurrences came in either order
  for (size_t at = column; at < numbers.size(); at += columns) {
    const auto found = std::lower_bound(values.begin(), values.end(), numbers[at]);
    const auto place = static_cast<size_t>(found - values.begin());
    result.place.push_back(place);
    if (seen[place]) continue;
    seen[place] = true;
    if (place == rising) ++rising;
    if (place == values.size() - 1 - falling) ++falling;
  }
  result.one_way = rising == values.size() || falling == values.size();
  if (falling == values.size()) {
    for (size_t& place : result.place) place = values.size() - 1 - place;
  }
  return result;
}

// Where each row stands on the grid; nothing where they do not fill it once.
std::optional<std::vector<size_t>> places_on(const std::vector<Coordinate>& axes, size_t rows) {
  size_t cells = 1;
  for (const Coordinate& axis : axes) {
    if (axis.length > rows / cells) return std::nullopt;
    cells *= axis.length;
  }
  if (cells != rows) return std::nullopt;
  std::vector<size_t> places(rows, 0);
  std::vector<bool> filled(rows, false);
  for (size_t row = 0; row < rows; ++row) {
    for (size_t a = axes.size(); a-- > 0;) {
      places[row] = places[row] * axes[a].length + axes[a].place[row];
    }
    if (filled[places[row]]) return std::nullopt;
    filled[places[row]] = true;
  }
  return places;
}

bool is_color(const std::string& name) {
  constexpr const char* names[] = {"R", "G", "B", "A", "r", "g", "b", "a"};
  return std::find(std::begin(names), std::end(names), name) != std::end(names);
}

CoordinateGrid placed(const std::vector<std::string>& names, const std::vector<double>& numbers,
                      const std::vector<Coordinate>& axes, const std::vector<size_t>& places) {
  const auto first = static_cast<std::ptrdiff_t>(axes.size());
  const size_t channels = names.size() - axes.size();
  CoordinateGrid grid;
  grid.columns.assign(names.begin(), names.begin() + first);
  grid.channels.assign(names.begin() + first, names.end());
  for (size_t a = axes.size(); a-- > 0;) grid.shape.push_back(static_cast<int>(axes[a].length));
  grid.shape.push_back(static_cast<int>(channels));
  grid.values.resize(places.size() * channels);
  for (size_t row = 0; row < places.size(); ++row) {
    for (size_t c = 0; c < channels; ++c) {
      grid.values[places[row] * channels + c] = numbers[row * names.size() + axes.size() + c];
    }
  }
  return grid;
}

}  // namespace

std::optional<CoordinateGrid> on_grid(const std::vector<std::string>& names,
                                      const std::vector<double>& numbers) {
  constexpr size_t most = 3;
  const size_t columns = names.size();
  if (columns < 2 || numbers.empty() || is_color(names[0])) return std::nullopt;
  const size_t rows = numbers.size() / columns;
  std::vector<Coordinate> axes;
  for (size_t a = 0; a < std::min(most, columns - 1); ++a) {
    for (size_t at = a; at < numbers.size(); at += columns) {
      if (!std::isfinite(numbers[at])) return std::nullopt;
    }
    axes.push_back(coordinate_of(numbers, columns, a));
    if (a == 0) continue;
    if (const auto places = places_on(axes, rows)) return placed(names, numbers, axes, *places);
  }
  axes.resize(1);
  if (!axes[0].one_way || axes[0].length != rows) return std::nullopt;
  return placed(names, numbers, axes, axes[0].place);
}

}  // namespace kiln::io

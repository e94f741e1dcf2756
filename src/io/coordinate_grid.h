// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace kiln::io {

/// A table in long form, a line an entry, put on the grid that its coordinates make.
struct CoordinateGrid {
  std::vector<int> shape;  ///< {.., n2, n1, channels}: the first column is the fastest
  std::vector<double> values;
  std::vector<std::string> columns;   ///< names of the coordinates
  std::vector<std::string> channels;  ///< names of the others
};

/// Takes as coordinates the fewest columns at the front, two or three, of which every combination
/// occurs once; else the first alone where it rises or falls throughout and is no colour. Each runs
/// as its values first occur where that rises or falls, else ascending.
/// @param numbers  row by row, as many a row as names
std::optional<CoordinateGrid> on_grid(const std::vector<std::string>& names,
                                      const std::vector<double>& numbers);

}  // namespace kiln::io

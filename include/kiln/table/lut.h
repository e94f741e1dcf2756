// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "kiln/brdf/energy.h"
#include "kiln/image/layers.h"

namespace kiln {

struct TableChannel {
  std::string name;     ///< of the image's plane: "R", "G", "Y"
  std::string meaning;  ///< "scale: multiplies F0"
};

/// A kind of table over n.v and roughness. A new one is one line on the list in lut.cpp.
struct TableFacts {
  std::string name;
  std::string summary;
  std::vector<TableChannel> channels;
  /// The channels' values from the split-sum terms of an entry.
  std::function<std::vector<double>(const SplitSumTerms<double>&)> values;
};

const std::vector<TableFacts>& all_tables();
std::vector<std::string> table_names();

/// @error Fault::Usage, naming the nearest known table
const TableFacts& find_table(const std::string& name);

/// The channels at one point, to about 1e-11.
/// @valid mu in [1e-4, 1], roughness in [0, 1]
std::vector<double> integrate_at(const TableFacts& table, double mu, double roughness);

/// A table and how wrong it is.
struct Lut {
  Layers
      image;  ///< x = n.v, y = perceptual roughness, texel centres (i + 1/2) / N, row 0 smoothest
  double entry_error = 0;  ///< greatest |entry - higher order| over all entries, before encoding
  double lookup_error =
      0;  ///< greatest error found of a bilinear lookup, mu in [1e-3,1], r in [0,1]
  double lookup_error_inner = 0;  ///< the same for mu >= 0.05 and roughness >= 0.1
};

/// @valid size at least 2x2
Lut build_lut(const TableFacts& table, Size size);

/// The entries alone, as doubles: [channel][y][x].
std::vector<std::vector<double>> integrate_entries(const TableFacts& table, Size size);

}  // namespace kiln

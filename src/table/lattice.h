// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "kiln/table/lut.h"

namespace kiln {

/// Points along each axis of a table, in file order.
struct Lattice {
  std::vector<Quantity> quantities;            ///< x, y, z
  std::vector<std::vector<double>> positions;  ///< of the quantities

  size_t count() const;
  TableGrid grid() const;
};

/// Of entries, and of what lookups are compared with.
Quality quality_of(const TableRecipe& recipe);

/// The lattice of a table's entries.
Lattice lattice_of(const std::vector<TableAxis>& axes);

/// Steps in a channel's own array for one step along each axis of a lattice.
std::vector<size_t> strides_of(const ChannelFacts& channel, const Lattice& lattice);

/// One row of a part of a lattice, x fastest, out of a channel's values on the lattice.
/// @param indices  of the part, along each axis
template <class Number>
void copy_row(const std::vector<double>& values, const std::vector<size_t>& strides,
              const LutIndices& indices, size_t row, Number* out) {
  size_t first = 0;
  for (size_t a = 1; a < indices.size(); ++a) {
    first += static_cast<size_t>(indices[a][row % indices[a].size()]) * strides[a];
    row /= indices[a].size();
  }
  for (const int x : indices[0]) {
    *out++ = static_cast<Number>(values[first + static_cast<size_t>(x) * strides[0]]);
  }
}

/// All of them.
std::vector<double> copy_part(const std::vector<double>& values, const std::vector<size_t>& strides,
                              const LutIndices& indices);

/// The indices of every point of a lattice.
LutIndices all_indices(const Lattice& lattice);

/// Fits have no truth to be compared with: without them, their channels stay empty.
enum class Fits { With, Without };

/// A recipe's channels on a lattice of points, made by the lobes' quadrature.
LutEntries fill_lattice(const TableRecipe& recipe, const Lattice& lattice, LobeCache& lobes,
                        Fits fits);

}  // namespace kiln

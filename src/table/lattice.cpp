// SPDX-License-Identifier: Apache-2.0
#include "lattice.h"

#include <numeric>

namespace kiln {

size_t Lattice::count() const {
  size_t product = 1;
  for (const auto& axis : positions) product *= axis.size();
  return product;
}

TableGrid Lattice::grid() const {
  TableGrid grid;
  for (size_t a = 0; a < quantities.size(); ++a) grid.of(quantities[a]) = positions[a];
  return grid;
}

Quality quality_of(const TableRecipe& recipe) {
  return recipe.exact ? Quality::Exact : Quality::Table;
}

Lattice lattice_of(const std::vector<TableAxis>& axes) {
  Lattice lattice;
  for (const TableAxis& axis : axes) {
    lattice.quantities.push_back(axis.mapping.quantity);
    lattice.positions.push_back(axis.coordinates);
  }
  return lattice;
}

std::vector<size_t> strides_of(const ChannelFacts& channel, const Lattice& lattice) {
  std::vector<size_t> strides(lattice.quantities.size(), 0);
  size_t step = 1;
  for (const Quantity quantity : channel.over) {
    for (size_t a = 0; a < lattice.quantities.size(); ++a) {
      if (lattice.quantities[a] != quantity) continue;
      strides[a] = step;
      step *= lattice.positions[a].size();
    }
  }
  return strides;
}

std::vector<double> copy_part(const std::vector<double>& values, const std::vector<size_t>& strides,
                              const LutIndices& indices) {
  size_t rows = 1;
  for (size_t a = 1; a < indices.size(); ++a) rows *= indices[a].size();
  const size_t width = indices[0].size();
  std::vector<double> part(rows * width);
  for (size_t row = 0; row < rows; ++row) {
    copy_row(values, strides, indices, row, &part[row * width]);
  }
  return part;
}

LutIndices all_indices(const Lattice& lattice) {
  LutIndices indices;
  for (const auto& axis : lattice.positions) {
    indices.emplace_back(axis.size());
    std::iota(indices.back().begin(), indices.back().end(), 0);
  }
  return indices;
}

LutEntries fill_lattice(const TableRecipe& recipe, const Lattice& lattice, LobeCache& lobes,
                        Fits fits) {
  const TableGrid grid = lattice.grid();
  const LutIndices indices = all_indices(lattice);
  TableContext context{recipe.models, grid, grid, lobes};
  LutEntries entries;
  entries.reserve(recipe.channels.size());
  for (const std::string& name : recipe.channels) {
    const ChannelFacts& channel = find_channel(name);
    const bool wanted = fits == Fits::With || !channel.fitted;
    entries.push_back(wanted
                          ? copy_part(channel.fill(context), strides_of(channel, lattice), indices)
                          : std::vector<double>{});
  }
  return entries;
}

}  // namespace kiln

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "kiln/image/layers.h"
#include "kiln/table/channel.h"

namespace kiln {

/// A kind of table: what it holds and how unless told otherwise. A new one is one line on the list
/// in kinds.cpp.
struct TableFacts {
  std::string name;
  std::string summary;
  std::vector<std::string> axes;      ///< x, y, z: mappings
  std::vector<std::string> channels;  ///< what it holds
  Lobe lobe = {};
  std::string source;
  Size size{128, 128};
  int depth = 16;  ///< of tables with a third axis
};

const std::vector<TableFacts>& all_tables();
std::vector<std::string> table_names();

/// @error Fault::Usage, naming the nearest known table
const TableFacts& find_table(const std::string& name);

enum class Origin {
  Top,    ///< the first row holds the least position of the y axis
  Bottom  ///< the last row does
};

/// A table in every detail.
struct TableRecipe {
  std::string table = "split-sum";
  TableModels models;
  std::vector<std::string> axes;      ///< empty: the kind's
  std::vector<std::string> channels;  ///< empty: the kind's
  Size size{128, 128};
  int depth = 16;  ///< of tables with a third axis
  Alignment alignment = Alignment::Center;
  Origin origin = Origin::Top;
  bool exact = false;  ///< entries to 1e-10 instead of 1e-6
};

/// The recipe of a kind: its models, axes and channels.
TableRecipe recipe_of(const TableFacts& facts);

/// Fills in what is empty and checks that axes, channels and models fit.
/// @error Fault::Usage
void complete(TableRecipe& recipe);

/// One axis of a table as made.
struct TableAxis {
  AxisMapping mapping;
  int count = 0;
  bool flipped = false;             ///< entry 0 holds the greatest position
  std::vector<double> coordinates;  ///< of the quantity, entry by entry
};

/// A table and how wrong it is.
struct Lut {
  TableRecipe recipe;
  std::vector<TableAxis> axes;               ///< x, y, z
  std::vector<std::vector<double>> entries;  ///< [channel][z][y][x]
  double entry_error = 0;                    ///< greatest |entry - higher order|, before encoding
  int entries_checked = 0;
  double fit_error = 0;     ///< mean share of light that a fit sends elsewhere; 0 without fits
  double lookup_error = 0;  ///< greatest of a linear lookup; mu in [1e-3,1], roughness in [0.01,1]
  double lookup_error_inner = 0;  ///< the same for mu >= 0.05 and roughness >= 0.1
};

/// @param recipe  completed
Lut build_lut(const TableRecipe& recipe);

/// As planes named R G B A (Y if there is one channel); slices stand on top of each other.
Layers to_image(const Lut& lut);
std::vector<std::string> plane_names(size_t channels);

/// The channels at one point, to about 1e-11. Coordinates by Quantity of the recipe's axes.
std::vector<double> integrate_at(const TableRecipe& recipe, const std::vector<double>& point);

/// What a sampler with clamped addressing and linear filtering reads.
double look_up(const Lut& lut, size_t channel, const std::vector<double>& point);

}  // namespace kiln

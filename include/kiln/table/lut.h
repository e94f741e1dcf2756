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

/// How wrong a table is.
struct LutErrors {
  double entry = 0;  ///< greatest |entry - higher order|, before encoding
  int entries_checked = 0;
  double fit = 0;           ///< mean share of light that a fit sends elsewhere; 0 without fits
  double lookup = 0;        ///< greatest of a linear lookup; mu in [1e-3,1], roughness in [0.01,1]
  double lookup_inner = 0;  ///< the same for mu >= 0.05 and roughness >= 0.1
};

/// [channel][z][y][x]
using LutEntries = std::vector<std::vector<double>>;
/// Some of the entries' indices along each axis: x, y, z.
using LutIndices = std::vector<std::vector<int>>;

/// A table whose entries are made as they are asked for, the same bits in whatever parts. Tables
/// of up to 2^18 entries, and all without a third axis, are made at once and held. Of others no
/// more is held than a part, what does not run over the third axis, and what fits one after the
/// other (ChannelFacts::fitted).
class LutSource {
 public:
  /// @param recipe  completed
  explicit LutSource(const TableRecipe& recipe);

  const TableRecipe& recipe() const { return recipe_; }
  const std::vector<TableAxis>& axes() const { return axes_; }
  int slices() const;          ///< along the third axis, 1 without
  int slices_at_once() const;  ///< as many as are made together at little cost

  /// Some slices as planes named R G B A (Y if there is one channel), on top of each other. To be
  /// called from the first slice to the last: what other slices do not need is forgotten.
  Layers image(int first, int count);

  /// The entries at the crossings of these indices. What they are made from is kept, so that the
  /// slices they lie in take less.
  LutEntries entries(const LutIndices& indices);

  /// The channels at other points, crossings of coordinates along each axis, with the quadrature
  /// that entries are made with. Empty for fitted channels.
  LutEntries integrals(const std::vector<std::vector<double>>& coordinates);

  /// LutErrors::fit
  double fit_error() const { return fit_error_; }

 private:
  struct Part;

  bool is_held(const ChannelFacts& channel) const;
  void hold();
  template <class Use>
  void make(const LutIndices& indices, Use&& use);

  TableRecipe recipe_;
  std::vector<TableAxis> axes_;
  TableGrid whole_;
  LobeCache lobes_;
  LutEntries held_;  // by channel: its own values on all of the table, or nothing
  double fit_error_ = 0;
};

/// Found by probing: entries against a higher order, lookups against the integrals between entries.
LutErrors errors_of(LutSource& source);

/// What a sampler with clamped addressing and linear filtering reads, by channel.
std::vector<double> look_up(LutSource& source, const std::vector<double>& point);

/// A table with all its entries, for those that fit into memory.
struct Lut {
  TableRecipe recipe;
  std::vector<TableAxis> axes;  ///< x, y, z
  LutEntries entries;
  LutErrors errors;
};

/// @param recipe  completed
Lut build_lut(const TableRecipe& recipe);

/// R G B A, or Y for one channel.
std::vector<std::string> plane_names(size_t channels);

/// The channels at one point, to about 1e-11. Coordinates by Quantity of the recipe's axes.
std::vector<double> integrate_at(const TableRecipe& recipe, const std::vector<double>& point);

}  // namespace kiln

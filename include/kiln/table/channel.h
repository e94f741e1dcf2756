// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "kiln/table/axis.h"
#include "kiln/table/lobe.h"

namespace kiln {

/// Which models a table integrates.
struct TableModels {
  Lobe lobe;
  FresnelChoice fresnel;
};

/// Where a table's entries lie: coordinates of each quantity, ascending or not.
struct TableGrid {
  std::array<std::vector<double>, quantity_count> coordinates;  ///< by Quantity; empty: not an axis

  const std::vector<double>& of(Quantity quantity) const {
    return coordinates[static_cast<size_t>(quantity)];
  }
  std::vector<double>& of(Quantity quantity) { return coordinates[static_cast<size_t>(quantity)]; }
};

/// Lobes made once for all channels and grids that ask for them.
class LobeCache {
 public:
  LobeCache(Quality quality, double floor_mu) : quality_(quality), floor_mu_(floor_mu) {}
  LobeIntegrals& of(const Lobe& lobe, const FresnelChoice& fresnel);
  Quality quality() const { return quality_; }

  /// What there is stays for good.
  void keep();
  /// Drops what nobody asked for since the last time, but for what is kept.
  void drop_unused();
  size_t size() const { return lobes_.size(); }

 private:
  struct Held {
    LobeIntegrals lobe;
    bool used = true;
    bool kept = false;
  };

  Quality quality_;
  double floor_mu_;
  std::map<std::string, Held> lobes_;
};

/// What a channel is filled from.
struct TableContext {
  const TableModels& models;
  const TableGrid& grid;
  /// What the grid is part of; parts are made by the means that fit the whole, so that their values
  /// are its own to the bit.
  const TableGrid& whole;
  LobeCache& lobes;
  /// Values that several channels share, made by whichever comes first.
  std::map<std::string, std::vector<std::vector<double>>> shared = {};
};

/// A function of some quantities that tables can hold. A new one is one line on a list.
struct ChannelFacts {
  std::string name;                  ///< "scale"
  std::vector<std::string> aliases;  ///< "A"
  std::string meaning;               ///< "scale: multiplies F0"
  std::vector<Quantity> over;        ///< what it depends on
  /// Values on the grid; the first quantity of `over` runs fastest.
  std::vector<double> (*fill)(TableContext&) = nullptr;
  /// A fit, not an integral: there is no truth to compare it with, only how well it fits. Each
  /// starts from another, so that a grid is only filled as a whole.
  bool fitted = false;
};

/// Lobe integrals and diffuse albedos, then the channels of special tables.
const std::vector<ChannelFacts>& all_channels();

/// @error Fault::Usage, naming the nearest known channel
const ChannelFacts& find_channel(const std::string& name);

/// Alpha for a perceptual roughness: its square, at least 1e-4; 0 for roughness 0, which stands for
/// the limit of a mirror.
double table_alpha(double roughness);

}  // namespace kiln

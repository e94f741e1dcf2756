// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include "file_windows.h"
#include "kiln/bake/bake.h"
#include "kiln/color/color.h"
#include "kiln/material/map_bands.h"
#include "kiln/material/resolver.h"
#include "kiln/pipeline/report.h"
#include "map_colors.h"

namespace kiln {

/// The maps of a set, read side by side from their first row to their last.
class SetReader {
 public:
  /// Opens the files that are needed and decides how they are read.
  /// @param set, color, config  outlive the reader
  /// @error the set's own fault; Fault::Input naming every missing file at once, or the unreadable
  ///        one
  SetReader(const PlannedSet& set, const ColorChoice& color, const ColorConfig& config,
            const MapNeeds& needs);

  /// What bakes see of it; outlived by the reader.
  const MapBands& bands() const { return bands_; }
  /// The rows below those before.
  MapRows next(int rows);
  /// What became of each slot, and of the texels read so far.
  SetRecord record() const;

 private:
  struct File {
    std::filesystem::path path;
    FileWindows windows;
  };
  /// A map that is an image: which channels of which file, and how its colours come to the working
  /// space.
  struct Map {
    PlannedMap planned;
    size_t file = 0;
    std::string letters = {};              ///< "rgb", "rg", "g", ...
    std::vector<std::string> names = {};   ///< of these channels in the file
    std::string from = {};                 ///< colour space, of colours
    std::optional<ColorCodes> codes = {};  ///< of colours in 8 bits, where they tell all
  };

  void open(const std::vector<PlannedMap>& maps);
  void add_constant(const PlannedMap& map);
  size_t file_of(const PlannedMap& map, const std::vector<PlannedMap>& maps);
  void decide_size(const MapNeeds& needs);
  void add_unread(SlotMaps& heads) const;
  const Map* find(Slot slot) const;

  Layers picked(const Map& map, const MapRows& rows) const;
  Layers fitted(const Map& map, Layers image, const MapRows& rows) const;
  SlotMaps stored(const MapRows& rows) const;
  Layers working_colors(const Map& map, const MapRows& rows) const;
  SlotMaps linear(const MapRows& rows) const;
  Svbrdf svbrdf(const MapRows& rows) const;
  SlotMap head(const Map& map) const;

  const PlannedSet& set_;
  const ColorChoice& color_;
  const ColorConfig& config_;
  SetRecord record_;
  std::vector<File> files_;
  std::vector<Map> maps_;
  SlotMaps constants_;
  std::optional<Resolver> resolver_;
  MapBands bands_;
  int next_row_ = 0;
  mutable std::mutex repairs_guard_;
  mutable Repairs repairs_;
};

}  // namespace kiln

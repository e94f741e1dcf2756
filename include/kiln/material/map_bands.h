// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "kiln/image/resample.h"
#include "kiln/material/normal_survey.h"
#include "kiln/material/svbrdf.h"
#include "kiln/material/workflow.h"

namespace kiln {

/// A map of a set, before its texels.
struct GivenMap {
  Slot slot = Slot::BaseColor;
  std::string source;  ///< file name, or "constant"
  bool is_constant = false;
  Size size{1, 1};          ///< of its own file
  int channels = 1;         ///< that the slot takes of it
  std::string stored_type;  ///< of its samples: "uint8", "half", ...; empty: a constant
  std::string color_space;  ///< that its colours are stored in; empty: numbers
};

/// Rows of a set as its files hold them. What they come to, MapBands tells.
struct MapRows {
  /// Rows of one file, from `first` on: those that resampling to the rows of the set reads.
  struct Window {
    int first = 0;
    Layers image;
  };
  RowRange rows;                ///< of the set
  std::vector<Window> windows;  ///< file by file
};

/// The maps of a set, read from the top and never held whole. The functions may be called from many
/// threads at once.
struct MapBands {
  std::string name;                         ///< of the set
  std::string working;                      ///< the colour space of what is resolved
  Size size;                                ///< of every map, once resampled: the largest's
  Wrap wrap = Wrap::Repeat;                 ///< what lies beyond its edges
  std::optional<double> alpha_cutoff = {};  ///< of a cutout: below it, opacity is 0
  std::vector<GivenMap> given;
  std::optional<NormalForm> normal;  ///< how its normal map, if any, is stored

  /// Values as stored: colours still encoded, normals as numbers; scaled and offset where the set
  /// says so, roughness perceptual. Constants have no image.
  std::function<SlotMaps(const MapRows&)> stored;
  /// Colours alone, in the working space.
  std::function<SlotMaps(const MapRows&)> linear;
  /// One BRDF per texel, colours in the working space.
  std::function<Svbrdf(const MapRows&)> svbrdf;
  /// All rows of one map as stored, at its own size; the file is read for it.
  std::function<Layers(Slot)> whole;

  const GivenMap* find(Slot slot) const {
    for (const GivenMap& map : given) {
      if (map.slot == slot) return &map;
    }
    return nullptr;
  }
};

}  // namespace kiln

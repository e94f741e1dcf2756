// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "kiln/image/layers.h"
#include "kiln/material/map_bands.h"

namespace kiln {

/// A texture of a MipSheet.
struct MipFile {
  std::string name;                ///< of the map
  std::vector<std::string> names;  ///< of the layers
  std::string preferred_type;  ///< "half": taken where the format holds it and none is asked for
  std::vector<std::pair<std::string, std::string>> attributes;  ///< metadata of the file
  /// Of colours: the space that all levels are in, and the one that the map is stored in, which
  /// files of integers keep. Empty: numbers.
  std::string color_from, color_stored;
};

/// Rows of one level of one texture.
struct MipRows {
  size_t file = 0;
  int level = 0;
  bool as_stored = false;  ///< colours are in color_stored already
  Layers image;
};

/// Textures of one size that are made together with all their levels from the maps of a set, a band
/// of rows at a time.
struct MipSheet {
  std::vector<MipFile> files;
  Size size;
  int levels = 1;
  std::string extension;        ///< of the files' format; empty: as the task's output says
  bool file_per_level = false;  ///< each level is an image of its own
  /// What has to be known of a band before it is filtered. May be called from many threads at once.
  std::function<std::shared_ptr<void>(const MapRows&)> read;
  /// The rows of all levels that are complete once this band follows those before: bands in order,
  /// one at a time.
  std::function<std::vector<MipRows>(void* band)> filter;
  /// Once all bands are filtered: what is to be told.
  std::function<std::vector<std::pair<std::string, double>>()> figures;
};

}  // namespace kiln

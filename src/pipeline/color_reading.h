// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "kiln/io/image_file.h"

namespace kiln {

/// The colour space that an image is read in: floating-point files are taken as linear, integers
/// as sRGB, unless somebody says otherwise.
inline std::string space_of(const std::string& stated, PixelType type) {
  if (!stated.empty()) return stated;
  return type == PixelType::Half || type == PixelType::Float ? "lin_rec709_scene"
                                                             : "srgb_rec709_scene";
}

inline std::string conversion_text(const std::string& from, const std::string& to) {
  return from == to ? from : from + " -> " + to;
}

/// A single channel in the place of a colour is grey.
inline Layers as_rgb(Layers picked) {
  if (picked.layers.size() != 1) return picked;
  Layers grey{picked.size, {}};
  grey.layers.push_back({"R", std::move(picked.layers[0].plane)});
  for (const char* name : {"G", "B"}) grey.layers.push_back({name, grey.layers[0].plane});
  return grey;
}

}  // namespace kiln

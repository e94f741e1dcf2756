// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>

#include "kiln/color/color.h"
#include "kiln/pipeline/plan.h"

namespace kiln {

/// How the colours of a map are read.
struct MapColor {
  std::string from;  ///< the space that they are in; empty: numbers
  std::string text;  ///< "data", or "srgb_rec709_scene -> lin_rec709_scene"
  std::string warning = {};
};

/// As stated, else by the file's type. The file's own tag is a hint, not an order: files are tagged
/// wrongly more often than not.
/// @error Fault::Input where the tag says otherwise and that is to be refused
MapColor decide_color(const PlannedMap& map, const FileFacts& facts, const ColorConfig& config,
                      const ColorChoice& color);

/// Brings the colours of a map into the working space, scaled and offset in linear Rec.709.
/// @param image  R, G and B; other layers stay
/// @param from   the space that it is in
void colors_to_working(Layers& image, const std::string& from, const PlannedMap& map,
                       const ColorConfig& config, const std::string& working);

/// The same, back in the space that it is in.
void scale_stored_colors(Layers& image, const std::string& from, const PlannedMap& map,
                         const ColorConfig& config);

/// The same for the constant of a colour slot; without a stated space it is in the working one.
/// @return what was converted, in words
std::string constant_to_working(SlotMap& constant, const PlannedMap& map, const ColorConfig& config,
                                const std::string& working);

/// What each code of 8 bits comes to in the working space, by channel.
using ColorCodes = std::array<std::array<float, 256>, 3>;

/// The same colours as colors_to_working makes of an image of such codes. Nothing where a channel
/// depends on the others, or is the same as before.
std::optional<ColorCodes> codes_to_working(const std::string& from, const PlannedMap& map,
                                           const ColorConfig& config, const std::string& working);

/// Planes R G B of codes of 8 bits, scaled to [0,1], become what they stand for.
void look_up(const ColorCodes& codes, Layers& image);

}  // namespace kiln

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "kiln/color/color.h"
#include "kiln/pipeline/plan.h"

namespace kiln {

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

}  // namespace kiln

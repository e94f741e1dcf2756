// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "preview_render.h"

namespace kiln {

// A contact sheet: the ball and the plane under three rotations of the environment, and the maps
// they are made of, each with a caption. The sheet is scene-linear as its pictures are. Of maps
// that hold numbers it shows the numbers, as a display that encodes as sRGB shows them.

struct ContactSheet {
  Rendered whole;              ///< the sheet and the means of its pictures
  std::optional<Layers> view;  ///< of differences: the sheet in false colours, for a display
};

/// So many texels each way are enough for its pictures, and for the ranges under its maps.
Size texels_of_contact_sheet(const PreviewBake::Settings& settings);

ContactSheet make_contact_sheet(const Svbrdf& maps, const ShadingInputs& inputs,
                                const PreviewBake::Settings& settings, Vec3<double> to_viewer);

}  // namespace kiln

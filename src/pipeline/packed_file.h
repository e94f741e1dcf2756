// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "kiln/pipeline/plan.h"

namespace kiln {

/// The set that lies in the channels of one image.
///
/// Of the files of a layout it is the one whose name the image's ends in, the longest such, or the
/// only one. What pack wrote comes back: smoothness as gloss, the green of DirectX normals as such.
/// @param layout  as parse_layout reads it
/// @error Fault::Usage where no file of the layout has that name, and for channels that no slot
///        takes
PlannedSet packed_set(const std::filesystem::path& image, const std::string& layout);

}  // namespace kiln

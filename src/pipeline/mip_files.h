// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "kiln/bake/mip_sheet.h"
#include "outputs.h"
#include "set_reader.h"

namespace kiln {

/// Makes the textures of a sheet with all their levels: rows are read, filtered and written side by
/// side, each file whole or not at all.
///
/// The task's `out` is a folder, a pattern with "{suffix}", or one file. What a file is follows
/// from its extension: a texture of all levels, or an image per level whose name gets "_<level>".
/// @param heed  called now and then; throws to stop
/// @error Fault::Usage when `out` names one file and the bake makes several, or another format than
///        the bake is told to make
Written write_mips(const Plan& plan, const Task& task, const MipSheet& sheet, SetReader& reader,
                   const ColorConfig& config, const std::function<void()>& heed);

}  // namespace kiln

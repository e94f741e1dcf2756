// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "outputs.h"
#include "set_reader.h"

namespace kiln {

/// The name of a map's file below the output folder: the pattern `out` with "{suffix}" replaced, or
/// a file in the folder `out`.
/// @error Fault::Usage when `out` names one file and the bake makes several
std::string map_file_name(const Task& task, const Artifact& artifact, size_t files);

/// Makes the files of a sheet: rows are read, made and written side by side, each file whole or not
/// at all.
/// @param heed  called now and then; throws to stop
Written write_sheet(const Plan& plan, const Task& task, const MapSheet& sheet, SetReader& reader,
                    const ColorConfig& config, const std::function<void()>& heed);

}  // namespace kiln

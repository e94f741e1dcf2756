// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "outputs.h"
#include "set_reader.h"

namespace kiln {

/// Makes the files of a sheet: rows are read, made and written side by side, each file whole or not
/// at all.
/// @param heed  called now and then; throws to stop
Written write_sheet(const Plan& plan, const Task& task, const MapSheet& sheet, SetReader& reader,
                    const ColorConfig& config, const std::function<void()>& heed);

}  // namespace kiln

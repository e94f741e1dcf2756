// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "kiln/pipeline/progress.h"

namespace kiln {

enum class Records { Keep, None };

/// Runs every task of a plan, set by set. What tasks share - a set's maps, an environment, a table
/// - is made when the first of them needs it and let go after the last. A task that fails takes
/// only those with it that need the same broken input.
///
/// @param records  Keep: write .kiln/report.json and .kiln/times.json in the output folder
/// @error Fault::Output when the output folder cannot be written, before anything is baked
Report run_plan(const Plan& plan, Records records, const Watcher& watcher = {});

}  // namespace kiln

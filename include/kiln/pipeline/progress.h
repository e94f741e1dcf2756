// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

#include "kiln/pipeline/report.h"

namespace kiln {

struct Progress {
  int done = 0;   ///< tasks finished, well or not
  int total = 0;  ///< tasks of the run
};

/// What a run tells while it works, and asks. Empty functions are not called; all calls come from
/// the thread that runs, but those of `interrupted`, which come from any.
struct Watcher {
  std::function<void(const TaskRecord&, const Progress&)> began;
  std::function<void(const TaskRecord&, const Progress&)> ended;
  std::function<void(const SetRecord&)> loaded;
  std::function<void(const EnvironmentRecord&)> lit;
  std::function<void(const std::string&)> warned;
  std::function<int()> interrupted;  ///< the signal to stop for, or 0
};

/// "[3/12] rocks: preview -> rocks/flat.exr, 1.3 s", or what went wrong.
std::string progress_line(const TaskRecord& record, const Progress& progress);

/// The same as one JSON object.
std::string progress_json(const TaskRecord& record, const Progress& progress);

/// "#######-----  3/12  rocks: preview", at most `columns` letters.
std::string progress_bar(const TaskRecord& record, const Progress& progress, int columns);

}  // namespace kiln

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "kiln/pipeline/progress.h"
#include "verb.h"

namespace kiln {

enum class ProgressStyle { Terminal, Plain, Json, None };

/// @param word  auto, tty, plain, json or none; auto is tty on a terminal, else plain
ProgressStyle progress_style(const std::string& word, const Globals& globals);

/// A watcher that tells the user on stderr: progress in that style, warnings unless quiet, and with
/// -v which file took which slot and why.
Watcher console_watcher(ProgressStyle style, const Globals& globals);

/// Which file took which slot, why, and with which colour space; one line a map.
std::string told(const SetRecord& set);
std::string told(const EnvironmentRecord& environment);

}  // namespace kiln

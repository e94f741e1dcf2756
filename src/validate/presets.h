// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "search.h"

namespace kiln::validate {

/// Engines whose lookups expect this convention; alike ones are all named.
std::vector<std::string> presets_like(const Sheet& sheet, const Candidate& candidate);

}  // namespace kiln::validate

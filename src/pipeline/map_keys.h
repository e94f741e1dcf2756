// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "kiln/pipeline/document.h"
#include "kiln/pipeline/pipeline.h"

namespace kiln {

/// Reads the keys of a map's block, all but `path`.
/// @param map  its slot is known
/// @error Fault::Usage for words that do not fit the slot
void read_map_keys(const Node& node, MapChoice& map);

}  // namespace kiln

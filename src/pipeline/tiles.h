// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "kiln/pipeline/plan.h"

namespace kiln {

/// Sets whose maps are patterns of UDIM tiles, spread over the tiles that are there: each tile that
/// any of its maps has is a set of its own, NAME.1001. A map that a tile lacks is left out with a
/// warning, so that its constant is used; a tile that is left without any map that a BRDF reads
/// fails, and so does a set without any tile. Maps that are no patterns belong to every tile.
std::vector<PlannedSet> tile_by_tile(std::vector<PlannedSet> sets);

}  // namespace kiln

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "kiln/bake/bake.h"
#include "kiln/pipeline/plan.h"

namespace kiln {

/// A material file that reads maps back as they were made, written below `folder`.
struct MaterialText {
  std::string text;
  std::vector<std::string> notes;  ///< maps that it cannot name
};

/// @param files  of the sheet, relative to `folder`, in its order
/// @param bands  how the set was read: its maps that the bake left alone stand beside the files,
///               the convention of normals as it was decided
/// @param set    outlives the call
MaterialText material_text(const MapSheet& sheet, const std::vector<std::string>& files,
                           const PlannedSet& set, const MapBands& bands,
                           const std::filesystem::path& folder);

}  // namespace kiln

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "kiln/pipeline/plan.h"

namespace kiln {

/// The materials of a document, each a set of its name, with what fills their slots. Materials
/// without one are called after the file; of equal names the later get a number.
/// @param reading  how maps are decoded unless the document says otherwise
/// @error Fault::Input for what is broken, missing or cannot be read as maps
std::vector<PlannedSet> document_sets(const std::filesystem::path& file,
                                      const WorkflowSettings& reading);

}  // namespace kiln

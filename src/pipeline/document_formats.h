// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "kiln/pipeline/plan.h"

namespace kiln {

/// A material of a document, as it is written there.
struct DocumentMaterial {
  PlannedSet set;            ///< its name may be empty
  std::optional<Wrap> wrap;  ///< of all its textures
};

/// @error Fault::Input
std::vector<DocumentMaterial> gltf_materials(const std::filesystem::path& file);
std::vector<DocumentMaterial> mtlx_materials(const std::filesystem::path& file);

}  // namespace kiln

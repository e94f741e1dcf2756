// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "kiln/bake/named_text.h"

namespace kiln {

/// How roughness may run along the levels of a chain.
std::vector<NamedText> list_roughness_curves();
/// Engines that environments can be laid out for.
std::vector<NamedText> list_environment_presets();
/// Files that environments can be written as.
std::vector<NamedText> list_environment_formats();

}  // namespace kiln

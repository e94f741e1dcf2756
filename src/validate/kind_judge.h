// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "kiln/validate/verify.h"
#include "kind_search.h"

namespace kiln::validate {

/// What sheets hold of the kinds of tables beside integrals of a lobe over n.v and roughness.
Verdict verify_kinds(const std::vector<Sheet>& sheets);

}  // namespace kiln::validate

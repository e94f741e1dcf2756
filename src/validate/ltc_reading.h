// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "kiln/validate/verify.h"
#include "sheet.h"

namespace kiln::validate {

/// Sheets of four channels as matrices of linearly transformed cosines, known by what they do: the
/// lobes that they make are measured against GGX.
Verdict verify_cosines(const std::vector<Sheet>& sheets);

}  // namespace kiln::validate

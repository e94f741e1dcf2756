// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace kiln {

/// On stderr, "kiln: error: " before each of its lines.
void print_error(const std::string& message);

}  // namespace kiln

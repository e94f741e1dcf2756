// SPDX-License-Identifier: Apache-2.0
#include "support/places.h"

namespace kiln::test {

std::filesystem::path source_folder() { return KILN_SOURCE_DIR; }

std::filesystem::path build_folder() { return KILN_BINARY_DIR; }

}  // namespace kiln::test

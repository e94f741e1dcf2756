// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

namespace kiln::test {

/// The checkout that the tests were built in. Known to one object file alone, so that all others
/// are the same in every checkout.
std::filesystem::path source_folder();

/// Where it was built.
std::filesystem::path build_folder();

}  // namespace kiln::test

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <optional>

#include "support/places.h"

namespace kiln::test {

/// The folder of real scans and reference values: $KILN_DATA, else `shared` beside the checkout.
inline std::optional<std::filesystem::path> real_data() {
  const char* set = std::getenv("KILN_DATA");
  const std::filesystem::path folder =
      set ? std::filesystem::path(set) : source_folder() / ".." / "shared";
  if (std::filesystem::is_directory(folder / "data")) return folder;
  return std::nullopt;
}

}  // namespace kiln::test

/// Skips the test, saying so, where the real data is not beside the project.
#define KILN_REQUIRE_REAL_DATA(name)                                                       \
  const auto name##_found = kiln::test::real_data();                                       \
  if (!name##_found) GTEST_SKIP() << "no real data: set KILN_DATA to the folder of scans"; \
  const std::filesystem::path name = *name##_found

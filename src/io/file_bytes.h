// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

namespace kiln::io {

using Bytes = std::vector<uint8_t>;
using ByteView = std::span<const uint8_t>;

/// The first bytes of a file, at most `count`.
/// @error Fault::Input when it is missing, a folder, empty or may not be read
Bytes first_bytes(const std::filesystem::path& path, size_t count);

/// The whole file. @error as first_bytes
Bytes all_bytes(const std::filesystem::path& path);

}  // namespace kiln::io

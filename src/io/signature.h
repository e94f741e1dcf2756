// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "file_bytes.h"

namespace kiln::io {

/// The format that a file's first bytes show: "openexr", "hdr", "dds", "ktx", "ktx2", "env", "npy",
/// or the name of a reader of OpenImageIO. Only these are ever tried on a file, so a file of
/// unknown contents reaches no decoder at all. Targa has no signature and is known by its
/// extension.
/// @error Fault::Input when the contents are of no known format
std::string format_by_contents(const std::filesystem::path& path, ByteView first);

/// The same, nothing where format_by_contents refuses.
std::optional<std::string> known_format(const std::filesystem::path& path, ByteView first);

inline constexpr size_t signature_length = 16;

}  // namespace kiln::io

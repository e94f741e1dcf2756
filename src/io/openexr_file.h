// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "kiln/io/image_file.h"
#include "reading.h"

namespace kiln::io {

/// The header of the first part. @error Fault::Input, without the path
FileFacts inspect_openexr(const std::filesystem::path& path, const ReadLimits& limits);

/// The first part, largest level, over its display window. @error Fault::Input, without the path
ImageFile read_openexr(const std::filesystem::path& path, const Reading& reading);

/// Scan lines, ZIP or not packed, channels in the order of their names.
/// @param type  Half or Float
/// @error Fault::Output, naming `shown_path`; Fault::Usage for names that a file cannot hold
WriteFacts write_openexr(const std::filesystem::path& temporary,
                         const std::filesystem::path& shown_path, const Layers& image,
                         const WriteOptions& options);

}  // namespace kiln::io

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "file_bytes.h"
#include "reading.h"
#include "texel_format.h"

namespace kiln::io {

/// read_image of a file whose contents are of this format, with the number of its slices.
/// @error Fault::Input, without the path
Volume read_volume(const std::filesystem::path& path, const std::string& format,
                   const Reading& reading);

/// The same of bytes in memory. @error as read_volume, and for OpenEXR
Volume volume_of_bytes(ByteView bytes, const std::string& format, const Reading& reading);

/// The header only. @error as volume_of_bytes
FileFacts facts_of_bytes(ByteView bytes, const std::string& format, const ReadLimits& limits);

}  // namespace kiln::io

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>

#include "band_encoder.h"
#include "kiln/io/image_file.h"
#include "reading.h"

namespace kiln::io {

/// The header of the first part. @error Fault::Input, without the path
FileFacts inspect_openexr(const std::filesystem::path& path, const ReadLimits& limits);

/// The first part, largest level, over its display window. @error Fault::Input, without the path
ImageFile read_openexr(const std::filesystem::path& path, const Reading& reading);

/// Scan lines, ZIP or not packed, channels in the order of their names; Half or Float.
/// @error Fault::Output and, for names that a file cannot hold, Fault::Usage; without the path
std::unique_ptr<BandEncoder> openexr_encoder(const FileToWrite& file, const StoredPlanes& layout);

}  // namespace kiln::io

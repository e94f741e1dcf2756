// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "reading.h"
#include "texel_format.h"

namespace kiln::io {

/// read_image of a file whose contents are of this format, with the number of its slices.
/// @error Fault::Input, without the path
Volume read_volume(const std::filesystem::path& path, const std::string& format,
                   const Reading& reading);

}  // namespace kiln::io

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfPixelType.h>

#include <string>
#include <vector>

#include "kiln/io/image_file.h"

namespace kiln::io {

/// The attribute that says how many of a file's levels are a texture's own.
inline constexpr char own_levels_name[] = "kiln:levels";

/// @valid Half or Float
Imf::PixelType library_type(PixelType type);

/// @error Fault::Usage for a name that is empty or used twice
void add_channels(const std::vector<std::string>& names, PixelType type, Imf::Header& header);

/// @error Fault::Usage for a name that is empty, used twice or the format's own
void add_attributes(const Attributes& attributes, Imf::Header& header);

}  // namespace kiln::io

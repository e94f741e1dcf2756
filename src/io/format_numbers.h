// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "kiln/io/image_file.h"
#include "texel_format.h"

namespace kiln::io {

/// DXGI_FORMAT of this type. @valid 1, 2 or 4 channels, 3 in Float; as many as a packed type has
/// @param srgb  the format of sRGB, encoded, where there is one
uint32_t dxgi_number(PixelType type, int channels, bool srgb = false);

/// Nothing where the format is block-compressed or unknown here.
std::optional<TexelFormat> dxgi_texel(uint32_t number);

/// VkFormat of this type. @valid as dxgi_number
uint32_t vulkan_number(PixelType type, int channels, bool srgb = false);
std::optional<TexelFormat> vulkan_texel(uint32_t number);

}  // namespace kiln::io

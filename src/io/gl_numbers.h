// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "kiln/io/image_file.h"
#include "texel_format.h"

namespace kiln::io {

/// The numbers of OpenGL that a KTX of version 1 has for its texels.
struct GlNumbers {
  uint32_t type = 0;
  uint32_t type_bytes = 0;  ///< of what a reader of another byte order has to turn
  uint32_t format = 0;
  uint32_t internal_format = 0;
  uint32_t base_format = 0;
};

/// @valid Half and Float of 1 to 4 channels; B10g11r11, whose type is the 0x8c3a that Filament's
///        tools write and its loader expects, not the specification's 0x8c3b; E5b9g9r9
GlNumbers gl_numbers(PixelType type, int channels);

/// What glType and glFormat of uncompressed texels stand for. The internal format says only what
/// the graphics library is to make of them.
/// @error Fault::Input, without the path, for what is not read
TexelFormat gl_texel(uint32_t type, uint32_t format);

}  // namespace kiln::io

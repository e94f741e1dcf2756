// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "kiln/image/layers.h"
#include "kiln/io/image_file.h"
#include "stored_planes.h"

namespace kiln::io {

/// Texels one behind the other, row by row, little-endian, without padding. Channels beyond the
/// planes are 0, the fourth is 1.
/// @param channels  of a texel, at least as many as planes; of no effect where they are packed
/// @valid type is not Rgbd8 (see rgbd_image)
std::string packed_texels(Size size, const StoredPlanes& stored, int channels, PixelType type,
                          WriteFacts& facts);

/// R G B as the four bytes of Rgbd8, scaled to [0,1]: to be stored as Uint8.
Layers rgbd_image(Size size, const StoredPlanes& stored, WriteFacts& facts);

/// @error Fault::Usage, without the path, for more channels than a texel of this type has
void require_room(const StoredPlanes& stored, PixelType type);

/// Bytes of one of these texels.
size_t packed_texel_bytes(PixelType type, int channels);

}  // namespace kiln::io

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "kiln/io/texture_file.h"
#include "kiln/store/byte_stream.h"

namespace kiln::io {

/// The faces of a cube one below the other as OpenEXR has them, and back: its view is from outside,
/// so that the sides are mirrored left-right and top and bottom are upside down.
/// @source OpenEXR, ImfEnvmap.h
Layers stacked_faces(const std::vector<Layers>& faces);
std::vector<Layers> faces_of_stack(const Layers& stack);

/// One part of tiles with all its levels, in ZIP; those that the texture lacks are averaged from
/// its last. @valid a well-formed texture of Half or Float
/// @error Fault::Usage, without the path, for a shape, samples or names that it cannot hold;
///        Fault::Output
void write_openexr_texture(const Texture& texture, const TextureWriteOptions& options,
                           ByteStream& out, WriteFacts& facts);

/// The first part over its data window: the levels that are half as large each, rounded down, those
/// of a cube as long as their faces are squares. @error Fault::Input, without the path
TextureFile read_openexr_texture(const std::filesystem::path& path, const ReadLimits& limits);

}  // namespace kiln::io

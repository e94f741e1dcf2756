// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string_view>

#include "file_bytes.h"
#include "kiln/io/texture_file.h"
#include "kiln/store/byte_stream.h"

/// Babylon.js environments: eight bytes, a manifest in JSON up to a zero, then an image of Rgbd8
/// for each face of each level, the largest level first, rows from the bottom.
///
/// @source Babylon.js, environmentTextureTools (manifest, order), rgbdDecode (colours); its loader
///         and its own files turn the images over, and their edges meet only so
namespace kiln::io {

inline constexpr std::string_view env_signature{"\x86\x16\x87\x96\xf6\xd6\x96\x36", 8};

/// @param path  as the user knows it
/// @valid a cube of 2^n texels with all its levels, R G B or fewer; the stream is empty
/// @error Fault::Usage, without the path, for an attribute twice; of the images' encoder
void write_env(const std::filesystem::path& path, const Texture& texture,
               const TextureWriteOptions& options, ByteStream& out, WriteFacts& facts);

/// Of the first face and level. @error Fault::Input, without the path
FileFacts inspect_env(ByteView bytes, const ReadLimits& limits);
ImageFile read_env(ByteView bytes, const ReadLimits& limits);

/// All of it. @error as read_env
TextureFile read_env_texture(ByteView bytes, const ReadLimits& limits);

}  // namespace kiln::io

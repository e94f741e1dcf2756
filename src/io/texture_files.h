// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "file_bytes.h"
#include "texel_format.h"

namespace kiln::io {

/// One level inside a container's bytes.
struct StoredLevel {
  long long width = 0;
  long long height = 0;
  size_t row_pitch = 0;     ///< [byte]
  size_t first = 0;         ///< where the first face begins, or the supercompressed level
  size_t face_step = 0;     ///< from one face to the next, in the level once it is inflated
  size_t stored_bytes = 0;  ///< of the supercompressed level
};

/// The levels' sizes and nothing else.
std::vector<StoredLevel> empty_levels(const StoredTexels& stored);

/// The first face and level of a DDS, of a legacy header or one of DirectX 10; nothing where its
/// texels are block-compressed or of masks that are no whole bytes, which OpenImageIO reads.
/// @error  Fault::Input, without the path
/// @source Microsoft, "DDS_HEADER", "DDS_PIXELFORMAT", "DDS_HEADER_DXT10", "D3DFORMAT"
std::optional<StoredTexels> dds_texels(ByteView bytes);
/// Each face has all its levels. @valid stored is within the limits, as for the other two
std::vector<StoredLevel> dds_levels(const StoredTexels& stored);

/// The first face and level of a KTX of version 1.
/// @error  Fault::Input, without the path, also for what is not read, by its name
/// @source Khronos, "KTX File Format Specification" 1.0
StoredTexels ktx1_texels(ByteView bytes);
/// @error as ktx1_texels
std::vector<StoredLevel> ktx1_levels(const StoredTexels& stored, ByteView bytes);

/// The same of version 2, plain or supercompressed with Zstandard. @error as ktx1_texels
/// @source Khronos, "KTX File Format Specification" 2.0
StoredTexels ktx2_texels(ByteView bytes);
std::vector<StoredLevel> ktx2_levels(const StoredTexels& stored, ByteView bytes);

/// Where the texels of one of these containers lie; nothing where another reader is to take it.
std::optional<StoredTexels> stored_texels(const std::string& format, ByteView bytes);

/// All faces and levels. @error Fault::Input, without the path
TextureFile read_stored_texture(const StoredTexels& stored, ByteView bytes,
                                const ReadLimits& limits);

}  // namespace kiln::io

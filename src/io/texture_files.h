// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "file_bytes.h"
#include "texel_format.h"

namespace kiln::io {

/// The first face and level of a DDS, of a legacy header or one of DirectX 10; nothing where its
/// texels are block-compressed or of masks that are no whole bytes, which OpenImageIO reads.
/// @error  Fault::Input, without the path
/// @source Microsoft, "DDS_HEADER", "DDS_PIXELFORMAT", "DDS_HEADER_DXT10", "D3DFORMAT"
std::optional<StoredTexels> dds_texels(ByteView bytes);

/// The first face and level of a KTX of version 1.
/// @error  Fault::Input, without the path, also for what is not read, by its name
/// @source Khronos, "KTX File Format Specification" 1.0
StoredTexels ktx1_texels(ByteView bytes);

/// The same of version 2, without supercompression. @error as ktx1_texels
/// @source Khronos, "KTX File Format Specification" 2.0
StoredTexels ktx2_texels(ByteView bytes);

}  // namespace kiln::io

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "kiln/core/size.h"
#include "kiln/io/image_file.h"
#include "stored_planes.h"

/// Encoders of the containers that hold tables. An image of `depth` slices is a volume.
namespace kiln::io {

/// What a container holds, apart from the texels.
struct Contents {
  Size slice;     ///< of one slice
  int depth = 1;  ///< slices
  int channels = 1;
};

/// What stands before the texels in a DDS: a header of DirectX 10, one level, rows without padding.
/// @param type         not Rgbd8
/// @param texel_bytes  of all texels together
/// @source Microsoft, "DDS_HEADER", "DDS_HEADER_DXT10"
std::string dds_header(const Contents& contents, PixelType type, size_t texel_bytes);
/// The header, then the texels.
std::string encode_dds(const Contents& contents, PixelType type, const std::string& texels);

/// What stands before the texels in a KTX 2 without supercompression, one level; key "KTXwriter"
/// from the attribute Software.
/// @param texel_bytes  of all texels together
/// @error  Fault::Usage for metadata names that the format cannot hold
/// @source Khronos, "KTX File Format Specification" 2.0; "Khronos Data Format Specification" 1.3
std::string ktx2_header(const Contents& contents, PixelType type, const Attributes& attributes,
                        size_t texel_bytes);
/// The header, then the texels.
std::string encode_ktx2(const Contents& contents, PixelType type, const Attributes& attributes,
                        const std::string& texels);

/// NumPy array, version 1.0. @source NumPy, "numpy.lib.format"
std::string encode_npy(const Contents& contents, PixelType type, const std::string& texels);

/// Comments, a header line, then one line an entry: coordinates, channels.
std::string encode_csv(const Contents& contents, const StoredPlanes& stored,
                       const WriteOptions& options);

/// A header for C99 and C++ with one array, named by the stem of `path`.
std::string encode_c_header(const std::filesystem::path& path, const Contents& contents,
                            const StoredPlanes& stored, const WriteOptions& options,
                            const std::string& texels);

/// The one of these that `format` names; `path` gives a name to what is in a C header.
/// @error Fault::Internal when depth or labels do not fit
std::string encode_table(std::string_view format, const std::filesystem::path& path,
                         const StoredPlanes& planes, const WriteOptions& options,
                         WriteFacts& facts);

}  // namespace kiln::io

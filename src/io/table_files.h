// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "band_encoder.h"
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

/// What stands before the texels of a NumPy array, version 1.0. @source NumPy, "numpy.lib.format"
std::string npy_header(const Contents& contents, PixelType type);

/// Comments, a header line, then one line an entry: coordinates, channels.
std::unique_ptr<BandEncoder> csv_encoder(const FileToWrite& file, const Contents& contents,
                                         const StoredPlanes& layout);

/// A header for C99 and C++ with one array, named by the stem of the path.
std::unique_ptr<BandEncoder> c_header_encoder(const FileToWrite& file, const Contents& contents,
                                              const StoredPlanes& layout);

/// The encoder of one of these formats.
/// @valid options.type is not Rgbd8
/// @error Fault::Internal when depth or labels do not fit; of the headers
std::unique_ptr<BandEncoder> table_encoder(const FileToWrite& file, const StoredPlanes& layout);

}  // namespace kiln::io

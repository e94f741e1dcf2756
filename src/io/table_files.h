// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "band_encoder.h"
#include "kiln/core/size.h"
#include "kiln/io/image_file.h"
#include "kiln/io/texture_file.h"
#include "stored_planes.h"

/// Encoders of the containers that hold tables. An image of `depth` slices is a volume.
namespace kiln::io {

/// What a container holds, apart from the texels.
struct Contents {
  Size slice;     ///< of one slice, of the largest level
  int depth = 1;  ///< slices
  int channels = 1;
  int faces = 1;  ///< 6: a cube
  int levels = 1;
  bool srgb = false;  ///< encoded, where the type has a format for it: Uint8
};

/// What stands before the texels in a DDS: a header of DirectX 10. Rows have no padding, each face
/// has all its levels, the largest first.
/// @param type         not Rgbd8
/// @param texel_bytes  of the largest level, all slices and one face
/// @source Microsoft, "DDS_HEADER", "DDS_HEADER_DXT10"
std::string dds_header(const Contents& contents, PixelType type, size_t texel_bytes);

/// Bytes of one level of a KTX 2, all slices and faces.
struct LevelBytes {
  size_t stored = 0;
  size_t texels = 0;  ///< more, where they are supercompressed
};

/// What a KTX 2 says of itself besides its contents.
struct Ktx2Description {
  Attributes attributes;
  ColorTag color_tag = ColorTag::None;
  Supercompression supercompression = Supercompression::None;
};

/// What stands before the smallest level in a KTX 2, whose levels follow from there, the smallest
/// first, each from a multiple of ktx2_alignment; key "KTXwriter" from the attribute Software.
/// @param levels  the largest first
/// @error  Fault::Usage for metadata names that the format cannot hold
/// @source Khronos, "KTX File Format Specification" 2.0; "Khronos Data Format Specification" 1.3
std::string ktx2_header(const Contents& contents, PixelType type,
                        const Ktx2Description& description, const std::vector<LevelBytes>& levels);
size_t ktx2_alignment(const Contents& contents, PixelType type, Supercompression supercompression);

/// The same for one level that is not supercompressed. @param texel_bytes  of all texels together
std::string ktx2_header(const Contents& contents, PixelType type, const Attributes& attributes,
                        size_t texel_bytes);

/// What stands before the levels in a KTX of version 1, each of which begins with its size.
/// @valid as gl_numbers
/// @error Fault::Usage for metadata names that the format cannot hold
/// @source Khronos, "KTX File Format Specification" 1.0; Filament, Ktx1Reader (types, key "sh")
std::string ktx1_header(const Contents& contents, PixelType type, const Attributes& attributes);

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

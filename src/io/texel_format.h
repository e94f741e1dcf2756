// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "file_bytes.h"
#include "kiln/io/image_file.h"
#include "kiln/io/texture_file.h"

namespace kiln::io {

/// How a container codes a texel.
enum class Coding {
  Unorm8,
  Unorm16,
  Half,
  Float,
  Rgb10a2,     ///< 32 bits, the first channel lowest
  R11g11b10f,  ///< unsigned floats of 5 bits exponent and 6, 6, 5 bits mantissa, R lowest
  Rgb9e5,      ///< three mantissas of 9 bits and a common exponent of 5, R lowest
};

/// Bytes of a texel as a name of a channel each sample; X is skipped.
struct TexelFormat {
  Coding coding = Coding::Unorm8;
  std::string_view channels;  ///< in the order of memory: "RGBA", "BGRX", "YA", "Y", ...
  bool srgb = false;
};

size_t texel_bytes(const TexelFormat& format);

/// The type that is coded so.
PixelType coded_as(Coding coding);

/// The smallest type of whole samples, or Rgb10a2, that holds it.
PixelType held_as(Coding coding);

/// Texels that are not block-compressed inside a container's bytes: the first face of the largest
/// level, and how many others there are.
struct StoredTexels {
  std::string format;  ///< "dds", ...
  TexelFormat texel;
  long long width = 0;
  long long height = 0;
  long long depth = 1;
  long long layers = 1;  ///< elements of an array
  long long faces = 1;
  long long levels = 1;
  size_t row_pitch = 0;     ///< [byte]
  size_t first = 0;         ///< where the first row begins, or the supercompressed level
  bool big_endian = false;  ///< samples
  bool rows_from_below = false;
  Supercompression supercompression = Supercompression::None;
  size_t stored_bytes = 0;  ///< of the supercompressed level
  Attributes attributes = {};
  std::vector<std::string> notes = {};
};

struct Volume {
  ImageFile file;  ///< slices from top to bottom
  int depth = 1;
};

/// Checks sizes against the limits and the bytes; notes what of the file is not of this one face.
/// @error Fault::Input, without the path, when too large or truncated
FileFacts facts_of_texels(const StoredTexels& stored, ByteView bytes, const ReadLimits& limits);

/// @error as facts_of_texels, and when a supercompressed level is damaged
Volume read_texels(const StoredTexels& stored, ByteView bytes, const ReadLimits& limits);

/// The level that is stored supercompressed, all of its layers, faces and slices.
/// @error as read_texels
Bytes inflated_level(const StoredTexels& stored, ByteView bytes, const ReadLimits& limits);

}  // namespace kiln::io

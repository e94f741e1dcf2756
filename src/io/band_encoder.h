// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <string_view>

#include "kiln/io/image_file.h"
#include "kiln/store/byte_stream.h"
#include "stored_planes.h"

namespace kiln::io {

/// A file that is about to be written.
struct FileToWrite {
  std::filesystem::path path;  ///< as the user knows it
  std::string_view format;     ///< of writable_formats()
  Size size;                   ///< of the whole image
  WriteOptions options;
  ByteStream& out;
  WriteFacts& facts;
};

/// Writes a file from its first row to its last. It is made with a layout, planes without texels
/// that tell names and number of the channels, and then writes what stands before the rows.
class BandEncoder {
 public:
  BandEncoder() = default;
  virtual ~BandEncoder() = default;
  BandEncoder(const BandEncoder&) = delete;
  BandEncoder& operator=(const BandEncoder&) = delete;

  /// Rows below those before, in planes of the same layout.
  /// @error Fault::Output, without the path, where the format's library fails
  virtual void add(const StoredPlanes& band) = 0;
  /// What stands behind the last row. @error as add()
  virtual void finish() = 0;
};

}  // namespace kiln::io

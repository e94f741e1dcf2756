// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "kiln/io/texture_writer.h"
#include "kiln/store/byte_stream.h"

namespace kiln::io {

/// A texture that is about to be written.
struct TextureToWrite {
  std::filesystem::path path;  ///< as the user knows it
  std::vector<Size> sizes;     ///< of the levels, the largest first
  std::vector<std::string> names;
  TextureWriteOptions options;
  ByteStream& out;
  WriteFacts& facts;
};

/// Writes the levels of a texture side by side.
class LevelEncoder {
 public:
  LevelEncoder() = default;
  virtual ~LevelEncoder() = default;
  LevelEncoder(const LevelEncoder&) = delete;
  LevelEncoder& operator=(const LevelEncoder&) = delete;

  /// Rows of a level from `first` on, which are below those before.
  /// @error Fault::Output, without the path
  virtual void add(int level, int first, const Layers& rows) = 0;
  /// @error as add()
  virtual void finish() = 0;
};

std::unique_ptr<LevelEncoder> openexr_levels(const TextureToWrite& texture);
std::unique_ptr<LevelEncoder> tiff_levels(const TextureToWrite& texture);
/// DDS and KTX 2. @error Fault::Usage for metadata names that the format cannot hold
std::unique_ptr<LevelEncoder> container_levels(std::string_view format,
                                               const TextureToWrite& texture);

}  // namespace kiln::io

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "kiln/io/texture_file.h"

namespace kiln {

/// What a texture of one image will be.
struct TextureLayout {
  Size size;                       ///< of the largest level
  int levels = 1;                  ///< each half as large as the one before, rounded down
  std::vector<std::string> names;  ///< of the layers
};

/// The formats that TextureWriter knows, by their extensions:
///
/// | extension  | types                      |
/// |------------|----------------------------|
/// | .exr       | half, float                |
/// | .tif .tx   | uint8, uint16, half, float |
/// | .dds .ktx2 | uint8, uint16, half, float |
const std::vector<WritableTexture>& growing_textures();

/// The format that the extension of `path` stands for. @error Fault::Usage, naming those known
const WritableTexture& growing_texture(const std::filesystem::path& path);

/// A texture file whose levels are written side by side, some rows at a time, and none held whole.
/// It appears when it is finished, and never if that does not come to pass.
///
/// .exr is one mip-mapped part of tiles, .tif a directory of tiles for each level with Pixar's tags
/// of textures: what OpenImageIO's texture system reads as they are. Both get the attributes
/// "textureformat" and "wrapmodes" (periodic) unless they are given. The types and channels are
/// those of write_texture; uint8 that is tagged sRGB has the sRGB formats of .dds and .ktx2.
class TextureWriter {
 public:
  /// @error Fault::Usage for what the format cannot hold, Fault::Output
  TextureWriter(const std::filesystem::path& path, const TextureLayout& layout,
                const TextureWriteOptions& options);
  ~TextureWriter();
  TextureWriter(const TextureWriter&) = delete;
  TextureWriter& operator=(const TextureWriter&) = delete;

  /// Rows of a level below those before; levels in any order. @error Fault::Output
  void add(int level, const Layers& rows);
  /// @error Fault::Output; Fault::Internal when rows are missing
  WriteFacts finish();

 private:
  struct Unfinished;
  std::unique_ptr<Unfinished> unfinished_;
};

}  // namespace kiln

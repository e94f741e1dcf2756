// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "kiln/io/image_bytes.h"
#include "kiln/io/image_file.h"

namespace kiln {

namespace io {
class RowSource;
}

/// Whether ImageRows holds such a file whole.
bool is_held_whole(const FileFacts& facts);

/// What ImageRows keeps of the bytes of such a file while it reads them [byte]: all of a small one,
/// a part of a large one.
long long bytes_kept(const std::filesystem::path& path, const FileFacts& facts);

/// An image file that is read from its first row to its last, some rows at a time: the same values
/// as read_image, while no more is held than a block of rows.
///
/// OpenEXR, PNG, JPEG, TIFF and what else OpenImageIO reads row by row come so. Held whole instead
/// are files that store an orientation (their first row is not the first that is shown), OpenEXR
/// files whose data window is not their display window, HDR, DDS, KTX, .npy and .env.
class ImageRows {
 public:
  /// @param channels  names of the channels wanted; empty: all
  /// @error Fault::Input when missing, unreadable or too large
  explicit ImageRows(const std::filesystem::path& path,
                     const std::vector<std::string>& channels = {}, const ReadLimits& limits = {});
  /// An image in memory, which is held.
  ImageRows(const ImageBytes& bytes, const std::vector<std::string>& channels = {},
            const ReadLimits& limits = {});
  ~ImageRows();
  ImageRows(ImageRows&&) noexcept;
  ImageRows& operator=(ImageRows&&) noexcept;

  const FileFacts& facts() const;
  /// The next rows, as many as are asked for.
  /// @valid not more than are left
  /// @error Fault::Input when the file turns out to be damaged there
  Layers next(int rows);

 private:
  std::filesystem::path path_;
  std::unique_ptr<io::RowSource> source_;
  Layers pending_;  ///< of a block of the source, rows not asked for yet
  int pending_row_ = 0;
  int read_ = 0;  ///< rows of the file that were read
};

}  // namespace kiln

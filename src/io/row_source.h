// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "kiln/io/image_file.h"
#include "reading.h"

namespace kiln::io {

/// A file whose rows are read from the top, in blocks that suit it.
class RowSource {
 public:
  RowSource() = default;
  virtual ~RowSource() = default;
  RowSource(const RowSource&) = delete;
  RowSource& operator=(const RowSource&) = delete;

  virtual const FileFacts& facts() const = 0;
  /// Names of the layers that read() fills, in their order.
  virtual const std::vector<std::string>& names() const = 0;
  /// Reads want multiples of so many rows, but for the last.
  virtual int block_rows() const = 0;
  /// The rows from `first` on, which follow those read before, into the rows of `image` from `at`
  /// on. @error Fault::Input, without the path
  virtual void read(int first, int rows, Layers& image, int at) = 0;
};

/// Rows as they are stored: those of the image where facts().stored_as_shown.
/// @error Fault::Input, without the path
std::unique_ptr<RowSource> openexr_rows(const std::filesystem::path& path, const Reading& reading);
std::unique_ptr<RowSource> openimageio_rows(const std::filesystem::path& path,
                                            const std::string& format, const Reading& reading);

}  // namespace kiln::io

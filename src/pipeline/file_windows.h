// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "kiln/image/resample.h"
#include "kiln/io/image_rows.h"
#include "kiln/material/map_bands.h"

namespace kiln {

/// An image file that is read from its first row to its last, in windows: the rows that resampling
/// to rows of another height reads.
class FileWindows {
 public:
  explicit FileWindows(ImageRows rows) : rows_(std::move(rows)) {}

  const FileFacts& facts() const { return rows_.facts(); }
  /// Of rows below those before, or above where windows side by side have rows in common.
  /// @param height  that is resampled to
  MapRows::Window next(int height, RowRange rows);

 private:
  ImageRows rows_;
  int next_ = 0;  ///< row
  Layers tail_;   ///< the last rows read, where the next window may want them again
};

}  // namespace kiln

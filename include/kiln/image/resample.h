// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "kiln/image/layers.h"

namespace kiln {

/// The plane at another size: exact area average where it shrinks, bilinear where it grows (texel
/// centres aligned, edges clamped), each axis by its own. A constant stays that constant.
Plane resample(const Plane& plane, Size size);
Layers resample(const Layers& image, Size size);

/// Rows of an image that is not held whole.
struct RowRange {
  int first = 0, count = 0;
};

/// The rows of an image `in` rows high that resampling it to `out` rows reads for some of these.
RowRange rows_read(int in, int out, RowRange rows);

/// Rows of what resample(plane, size) gives, from those of the plane that rows_read names: the
/// same values.
/// @param window  of the plane, `height` rows high, the rows from `window_first` on
Plane resample_rows(const Plane& window, int window_first, int height, Size size, RowRange rows);

/// Half the size (each axis halved, rounded up, at least 1) by exact area average.
Plane halve(const Plane& plane);

}  // namespace kiln

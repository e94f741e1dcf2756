// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "file_bytes.h"
#include "kiln/image/number_array.h"
#include "texel_format.h"

namespace kiln::io {

/// A NumPy array of versions 1 to 3, either byte order, C or Fortran order. Unsigned integers of 8
/// and 16 bits are scaled to [0,1], wider ones and signed ones stand as they are.
/// @error  Fault::Input, without the path
/// @source NumPy, "numpy.lib.format"
NumberArray read_npy_array(ByteView bytes, const ReadLimits& limits);

/// The same as an image: [h][w], [h][w][c] with at most 4 channels, [d][h][w], [d][h][w][c].
Volume read_npy_image(ByteView bytes, const ReadLimits& limits);
FileFacts inspect_npy(ByteView bytes, const ReadLimits& limits);

}  // namespace kiln::io

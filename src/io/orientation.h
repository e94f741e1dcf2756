// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "kiln/io/image_file.h"

namespace kiln::io {

/// The size of a stored image once it is turned upright.
/// @param orientation  EXIF's number, 1 to 8: which edges the stored row 0 and column 0 are
/// @source Exif 2.32, tag 274 (Orientation)
Size oriented(Size stored, int orientation);

/// The image turned upright.
Layers oriented(Layers stored, int orientation);

/// Says so in the notes when something had to be turned.
void note_orientation(int orientation, FileFacts& facts);

}  // namespace kiln::io

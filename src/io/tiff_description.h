// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "kiln/io/image_file.h"

namespace kiln::io {

/// Attributes as TIFF holds them, which has tags for a few names only: all others become lines
/// "name: text" behind the first of ImageDescription.
Attributes as_tiff_tags(const Attributes& attributes);

/// What as_tiff_tags was given; in any file, lines "name: text" of ImageDescription behind its
/// first become attributes where the name is one word.
Attributes from_tiff_tags(const Attributes& tags);

}  // namespace kiln::io

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <OpenEXR/ImfInputPart.h>

#include <string>
#include <vector>

#include "kiln/image/layers.h"

namespace kiln::io {

/// Whether read_zip_rows knows the lines of this part: packed by ZIP, half or float, none
/// subsampled.
bool has_zip_rows(const Imf::Header& header);

/// Rows [first, end) of the data window, which lies in the display window, into the rows from `at`
/// on, as Imf::InputPart::readPixels gives them, in half its time: libdeflate unpacks faster than
/// zlib.
/// @param first  where a block of 16 lines begins
/// @error Fault::Input when the block is damaged
void read_zip_rows(Imf::InputPart& part, const std::vector<std::string>& channels, int first,
                   long long end, Layers& image, int at);

}  // namespace kiln::io

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "band_encoder.h"
#include "file_bytes.h"
#include "kiln/io/image_file.h"
#include "reading.h"

namespace kiln::io {

/// Radiance picture (RGBE): header only. @error Fault::Input, without the path
FileFacts inspect_hdr(ByteView bytes, const ReadLimits& limits);

/// Pixels flat or run-length encoded in either way; all eight orientations.
///
///     value = mantissa * 2^(exponent - 136), 0 where the exponent is 0
///
/// @error  Fault::Input, without the path, when the scan lines do not fill the claimed size
/// @source Ward, "Real Pixels", Graphics Gems II, 1991; Radiance reference, "picture" file format
ImageFile read_hdr(ByteView bytes, const Reading& reading);

/// RGBE, run-length encoded; mantissas rounded to nearest.
/// One channel is repeated, a missing third is 0. Attributes become comments "# name: text", which
/// read_hdr gives back; line breaks become blanks.
/// @valid a layout of 1 to 3 planes, in the order R G B
std::unique_ptr<BandEncoder> hdr_encoder(const FileToWrite& file);

}  // namespace kiln::io

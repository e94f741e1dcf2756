// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "band_encoder.h"
#include "file_bytes.h"
#include "kiln/io/image_file.h"
#include "reading.h"
#include "stored_planes.h"

namespace kiln::io {

/// @param format  OpenImageIO's name of the reader, told by the contents
/// @error Fault::Input, without the path
FileFacts inspect_by_openimageio(const std::string& format, ByteView bytes,
                                 const ReadLimits& limits);

/// @error Fault::Input, without the path
ImageFile read_by_openimageio(const std::string& format, ByteView bytes, const Reading& reading);

/// PNG, JPEG and TIFF. @error Fault::Output, without the path
std::unique_ptr<BandEncoder> openimageio_encoder(const FileToWrite& file,
                                                 const StoredPlanes& layout);

}  // namespace kiln::io

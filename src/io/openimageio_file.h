// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

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

/// The whole file in memory. @error Fault::Output, without the path
std::string encode_by_openimageio(const std::string& format, Size size, const StoredPlanes& stored,
                                  const WriteOptions& options, WriteFacts& facts);

}  // namespace kiln::io

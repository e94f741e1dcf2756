// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "kiln/io/texture_file.h"
#include "kiln/store/byte_stream.h"

namespace kiln::io {

/// A texture as KTX 2, KTX 1 or DDS, by the name of the format.
/// @valid well-formed, and what the format holds; the stream is empty
/// @error Fault::Usage, without the path, for names of attributes that the format cannot hold
void write_container(std::string_view format, const Texture& texture,
                     const TextureWriteOptions& options, ByteStream& out, WriteFacts& facts);

}  // namespace kiln::io

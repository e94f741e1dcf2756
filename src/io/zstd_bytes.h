// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "file_bytes.h"

namespace kiln::io {

/// One Zstandard frame that states the size of its contents. @source RFC 8878
std::string zstd_compressed(std::string_view bytes);

/// @param count  how many bytes must come out
/// @error Fault::Input, without the path, when it is damaged or others come out
Bytes zstd_inflated(ByteView frames, size_t count);

/// Whether so many bytes of frames can hold so many: each block, of 4 bytes or more, yields 128 KiB
/// at most. @source ibid., 3.1.1.2
bool zstd_may_hold(size_t frame_bytes, size_t count);

}  // namespace kiln::io

// SPDX-License-Identifier: Apache-2.0
#include "zstd_bytes.h"

#include <fmt/format.h>
#include <zstd.h>

#include "kiln/core/error.h"

namespace kiln::io {

std::string zstd_compressed(std::string_view bytes) {
  constexpr int effort = 7;  // of 22; texels of halves shrink by 0.5 % more in three times the time
  std::string frame(ZSTD_compressBound(bytes.size()), '\0');
  const size_t size = ZSTD_compress(frame.data(), frame.size(), bytes.data(), bytes.size(), effort);
  if (ZSTD_isError(size) != 0) {
    throw Error(Fault::Internal, fmt::format("Zstandard: {}", ZSTD_getErrorName(size)));
  }
  frame.resize(size);
  return frame;
}

Bytes zstd_inflated(ByteView frames, size_t count) {
  Bytes bytes(count);
  const size_t got = ZSTD_decompress(bytes.data(), count, frames.data(), frames.size());
  if (ZSTD_isError(got) != 0) {
    throw Error(Fault::Input, fmt::format("damaged Zstandard frame: {}", ZSTD_getErrorName(got)));
  }
  if (got != count) {
    throw Error(Fault::Input,
                fmt::format("a Zstandard frame holds {} bytes, expected {}", got, count));
  }
  return bytes;
}

bool zstd_may_hold(size_t frame_bytes, size_t count) {
  constexpr size_t largest_block = 128 << 10, smallest_stored = 4;
  return count / largest_block <= frame_bytes / smallest_stored;
}

}  // namespace kiln::io

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstring>
#include <string>
#include <string_view>

#include "file_bytes.h"
#include "kiln/core/error.h"

namespace kiln::io {

/// Reads numbers off the front of some bytes; every read is checked.
class ByteCursor {
 public:
  explicit ByteCursor(ByteView bytes, size_t at = 0) : bytes_(bytes), at_(at) {}

  size_t at() const { return at_; }
  size_t left() const { return at_ < bytes_.size() ? bytes_.size() - at_ : 0; }
  void set_big_endian(bool big) { big_endian_ = big; }
  void skip(size_t count) { at_ += count; }

  /// @error Fault::Input when the bytes end before
  uint64_t number(size_t count) {
    const std::string_view bytes = text(count);
    uint64_t value = 0;
    for (size_t i = 0; i < count; ++i) {
      const size_t from = big_endian_ ? i : count - 1 - i;
      value = value << 8 | static_cast<uint8_t>(bytes[from]);
    }
    return value;
  }
  uint32_t u32() { return static_cast<uint32_t>(number(4)); }
  uint64_t u64() { return number(8); }
  std::string_view text(size_t count) {
    if (count > left()) throw Error(Fault::Input, "truncated: the header has no end");
    const auto* from = reinterpret_cast<const char*>(bytes_.data()) + at_;
    at_ += count;
    return {from, count};
  }

 private:
  ByteView bytes_;
  size_t at_ = 0;
  bool big_endian_ = false;
};

}  // namespace kiln::io

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <initializer_list>
#include <string>

namespace kiln::io {

/// The low `count` bytes of a number, the lowest first.
inline void append_little(std::string& bytes, uint64_t value, int count) {
  for (int i = 0; i < count; ++i) bytes += static_cast<char>(value >> (8 * i) & 255);
}

inline void append_words(std::string& bytes, std::initializer_list<uint32_t> words) {
  for (const uint32_t word : words) append_little(bytes, word, 4);
}

/// Zeros up to a multiple of `step`.
inline void pad_to(std::string& bytes, size_t step) {
  bytes.resize((bytes.size() + step - 1) / step * step, '\0');
}

}  // namespace kiln::io

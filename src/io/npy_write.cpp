// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <string_view>

#include "byte_text.h"
#include "table_files.h"

namespace kiln::io {
namespace {

std::string_view description(PixelType type) {
  switch (type) {
    case PixelType::Uint8:
      return "|u1";
    case PixelType::Uint16:
      return "<u2";
    case PixelType::Half:
      return "<f2";
    default:
      return "<f4";
  }
}

std::string shape_text(const Contents& contents) {
  std::string text;
  if (contents.depth > 1) text += fmt::format("{}, ", contents.depth);
  text += fmt::format("{}, {}", contents.slice.height, contents.slice.width);
  if (contents.channels > 1) text += fmt::format(", {}", contents.channels);
  return text;
}

}  // namespace

std::string npy_header(const Contents& contents, PixelType type) {
  std::string header = fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': ({}), }}",
                                   description(type), shape_text(contents));
  constexpr size_t before = 10, step = 64;
  const size_t whole = (before + header.size() + 1 + step - 1) / step * step;
  header.resize(whole - before - 1, ' ');
  header += '\n';
  std::string bytes("\x93NUMPY\x01\0", 8);
  append_little(bytes, header.size(), 2);
  return bytes += header;
}

}  // namespace kiln::io

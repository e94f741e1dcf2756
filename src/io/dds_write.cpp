// SPDX-License-Identifier: Apache-2.0
#include "byte_text.h"
#include "format_numbers.h"
#include "table_files.h"

namespace kiln::io {

std::string dds_header(const Contents& contents, PixelType type, size_t texel_bytes) {
  const bool volume = contents.depth > 1;
  const auto width = static_cast<uint32_t>(contents.slice.width);
  const auto height = static_cast<uint32_t>(contents.slice.height);
  const auto depth = static_cast<uint32_t>(contents.depth);
  const auto rows = static_cast<size_t>(height) * depth;
  // caps, height, width, pitch, pixel format; depth
  constexpr uint32_t flags = 0x1 | 0x2 | 0x4 | 0x8 | 0x1000;
  constexpr uint32_t depth_flag = 0x800000;
  constexpr uint32_t texture = 0x1000, complex = 0x8, volume_caps = 0x200000;
  constexpr uint32_t by_four_cc = 4;
  std::string bytes = "DDS ";
  append_words(bytes, {124, volume ? flags | depth_flag : flags, height, width,
                       static_cast<uint32_t>(texel_bytes / rows), volume ? depth : 0, 1});
  append_words(bytes, {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0});
  append_words(bytes, {32, by_four_cc});
  bytes += "DX10";
  append_words(bytes, {0, 0, 0, 0, 0});
  append_words(bytes, {volume ? texture | complex : texture, volume ? volume_caps : 0, 0, 0, 0});
  constexpr uint32_t texture_2d = 3, texture_3d = 4;
  append_words(bytes,
               {dxgi_number(type, contents.channels), volume ? texture_3d : texture_2d, 0, 1, 0});
  return bytes;
}

std::string encode_dds(const Contents& contents, PixelType type, const std::string& texels) {
  return dds_header(contents, type, texels.size()) += texels;
}

}  // namespace kiln::io

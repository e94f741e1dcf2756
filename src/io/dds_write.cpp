// SPDX-License-Identifier: Apache-2.0
#include "byte_text.h"
#include "format_numbers.h"
#include "table_files.h"

namespace kiln::io {

std::string dds_header(const Contents& contents, PixelType type, size_t texel_bytes) {
  const bool volume = contents.depth > 1, cube = contents.faces == 6, mips = contents.levels > 1;
  const auto width = static_cast<uint32_t>(contents.slice.width);
  const auto height = static_cast<uint32_t>(contents.slice.height);
  const auto depth = static_cast<uint32_t>(contents.depth);
  const auto rows = static_cast<size_t>(height) * depth;
  // caps, height, width, pitch, pixel format; depth
  constexpr uint32_t flags = 0x1 | 0x2 | 0x4 | 0x8 | 0x1000;
  constexpr uint32_t depth_flag = 0x800000, mips_flag = 0x20000;
  constexpr uint32_t texture = 0x1000, complex = 0x8, mips_caps = 0x400008;
  constexpr uint32_t volume_caps = 0x200000, cube_caps = 0xfe00;  // with each of its faces
  constexpr uint32_t by_four_cc = 4;
  std::string bytes = "DDS ";
  append_words(bytes, {124, flags | (volume ? depth_flag : 0) | (mips ? mips_flag : 0), height,
                       width, static_cast<uint32_t>(texel_bytes / rows), volume ? depth : 0,
                       static_cast<uint32_t>(contents.levels)});
  append_words(bytes, {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0});
  append_words(bytes, {32, by_four_cc});
  bytes += "DX10";
  append_words(bytes, {0, 0, 0, 0, 0});
  append_words(bytes, {texture | (volume || cube ? complex : 0) | (mips ? mips_caps : 0),
                       (volume ? volume_caps : 0) | (cube ? cube_caps : 0), 0, 0, 0});
  constexpr uint32_t texture_2d = 3, texture_3d = 4, cube_flag = 4;
  append_words(bytes, {dxgi_number(type, contents.channels, contents.srgb),
                       volume ? texture_3d : texture_2d, cube ? cube_flag : 0, 1, 0});
  return bytes;
}

}  // namespace kiln::io

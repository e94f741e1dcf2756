// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>

#include "byte_cursor.h"
#include "format_numbers.h"
#include "texture_files.h"

namespace kiln::io {
namespace {

struct PixelFormat {
  uint32_t flags = 0;
  std::string_view four_cc;
  uint32_t bits = 0;
  std::array<uint32_t, 4> masks{};  // R (or luminance), G, B, A
};

struct Header {
  uint32_t height = 0;
  uint32_t width = 0;
  uint32_t depth = 0;
  uint32_t mips = 0;
  PixelFormat pixels;
  uint32_t caps2 = 0;
};

constexpr uint32_t cube_caps = 0x200, faces_caps = 0xfc00, volume_caps = 0x200000;
constexpr uint32_t alpha_flag = 0x1, four_cc_flag = 0x4, rgb_flag = 0x40, luminance_flag = 0x20000;

Header header_of(ByteCursor& cursor) {
  Header header;
  cursor.skip(4 + 4 + 4);  // magic, size, flags
  header.height = cursor.u32();
  header.width = cursor.u32();
  cursor.skip(4);  // pitch, which writers get wrong: rows are never padded
  header.depth = cursor.u32();
  header.mips = cursor.u32();
  cursor.skip(11 * 4 + 4);
  header.pixels.flags = cursor.u32();
  header.pixels.four_cc = cursor.text(4);
  header.pixels.bits = cursor.u32();
  for (uint32_t& mask : header.pixels.masks) mask = cursor.u32();
  cursor.skip(4);
  header.caps2 = cursor.u32();
  cursor.skip(3 * 4);
  return header;
}

// Formats that stand as a number where the four letters would.
std::optional<TexelFormat> numbered_format(std::string_view four_cc) {
  if (four_cc.substr(1) != std::string_view("\0\0\0", 3)) return std::nullopt;
  using enum Coding;
  switch (static_cast<uint8_t>(four_cc[0])) {
    case 36:
      return TexelFormat{Unorm16, "RGBA"};
    case 111:
      return TexelFormat{Half, "Y"};
    case 112:
      return TexelFormat{Half, "RG"};
    case 113:
      return TexelFormat{Half, "RGBA"};
    case 114:
      return TexelFormat{Float, "Y"};
    case 115:
      return TexelFormat{Float, "RG"};
    case 116:
      return TexelFormat{Float, "RGBA"};
    default:
      return std::nullopt;
  }
}

struct Masked {
  uint32_t bits;
  std::array<uint32_t, 4> masks;
  bool luminance;
  TexelFormat texel;
};

constexpr Masked masked[] = {
    {8, {0xff, 0, 0, 0}, true, {Coding::Unorm8, "Y"}},
    {16, {0xff, 0, 0, 0xff00}, true, {Coding::Unorm8, "YA"}},
    {16, {0xffff, 0, 0, 0}, true, {Coding::Unorm16, "Y"}},
    {8, {0xff, 0, 0, 0}, false, {Coding::Unorm8, "Y"}},
    {16, {0xff, 0xff00, 0, 0}, false, {Coding::Unorm8, "RG"}},
    {16, {0xffff, 0, 0, 0}, false, {Coding::Unorm16, "Y"}},
    {24, {0xff0000, 0xff00, 0xff, 0}, false, {Coding::Unorm8, "BGR"}},
    {24, {0xff, 0xff00, 0xff0000, 0}, false, {Coding::Unorm8, "RGB"}},
    {32, {0xff0000, 0xff00, 0xff, 0xff000000}, false, {Coding::Unorm8, "BGRA"}},
    {32, {0xff0000, 0xff00, 0xff, 0}, false, {Coding::Unorm8, "BGRX"}},
    {32, {0xff, 0xff00, 0xff0000, 0xff000000}, false, {Coding::Unorm8, "RGBA"}},
    {32, {0xff, 0xff00, 0xff0000, 0}, false, {Coding::Unorm8, "RGBX"}},
    {32, {0xffff, 0xffff0000, 0, 0}, false, {Coding::Unorm16, "RG"}},
    {32, {0x3ff, 0xffc00, 0x3ff00000, 0xc0000000}, false, {Coding::Rgb10a2, "RGBA"}},
    {32, {0x3ff00000, 0xffc00, 0x3ff, 0xc0000000}, false, {Coding::Rgb10a2, "BGRA"}}};

std::optional<TexelFormat> masked_format(const PixelFormat& pixels) {
  const bool luminance = (pixels.flags & luminance_flag) != 0;
  if (!luminance && (pixels.flags & rgb_flag) == 0) return std::nullopt;
  std::array<uint32_t, 4> masks = pixels.masks;
  if ((pixels.flags & alpha_flag) == 0) masks[3] = 0;
  for (const Masked& one : masked) {
    const bool same = one.luminance == luminance && one.bits == pixels.bits;
    if (same && one.masks == masks) return one.texel;
  }
  return std::nullopt;
}

// What is left to OpenImageIO must be a format at all: masks without a bit are an endless loop to
// it.
void check_masks(const PixelFormat& pixels) {
  const bool colors = (pixels.flags & rgb_flag) != 0;
  const bool known_bits = pixels.bits % 8 == 0 && pixels.bits >= 8 && pixels.bits <= 32;
  const bool some = colors || (pixels.flags & luminance_flag) != 0;
  const bool whole = pixels.masks[0] != 0 &&
                     (!colors || (pixels.masks[1] != 0 && pixels.masks[2] != 0)) &&
                     ((pixels.flags & alpha_flag) == 0 || pixels.masks[3] != 0);
  if (known_bits && some && whole) return;
  throw Error(
      Fault::Input,
      fmt::format("texels of {} bits with the masks {:x} {:x} {:x} {:x} are not read", pixels.bits,
                  pixels.masks[0], pixels.masks[1], pixels.masks[2], pixels.masks[3]));
}

// The header of DirectX 10 behind the other one.
std::optional<TexelFormat> dx10_format(ByteCursor& cursor, StoredTexels& stored) {
  const uint32_t number = cursor.u32();
  cursor.skip(4);
  const uint32_t flags = cursor.u32();
  const uint32_t images = cursor.u32();
  cursor.skip(4);
  constexpr uint32_t cube_flag = 4;
  if ((flags & cube_flag) != 0) stored.faces = 6;
  stored.layers = std::max(1u, images);
  return dxgi_texel(number);
}

}  // namespace

std::optional<StoredTexels> dds_texels(ByteView bytes) {
  ByteCursor cursor(bytes);
  const Header header = header_of(cursor);
  StoredTexels stored;
  std::optional<TexelFormat> texel;
  if ((header.pixels.flags & four_cc_flag) == 0) {
    texel = masked_format(header.pixels);
    if (!texel) check_masks(header.pixels);
  } else if (header.pixels.four_cc == "DX10") {
    texel = dx10_format(cursor, stored);
  } else {
    texel = numbered_format(header.pixels.four_cc);
  }
  if (!texel) return std::nullopt;
  stored.format = "dds";
  stored.texel = *texel;
  stored.width = header.width;
  stored.height = header.height;
  if ((header.caps2 & volume_caps) != 0) stored.depth = std::max(1u, header.depth);
  if ((header.caps2 & cube_caps) != 0 && stored.faces == 1) {
    stored.faces = std::max(2, std::popcount(header.caps2 & faces_caps));
  }
  stored.levels = std::max(1u, header.mips);
  stored.row_pitch = static_cast<size_t>(header.width) * texel_bytes(stored.texel);
  stored.first = cursor.at();
  return stored;
}

std::vector<StoredLevel> dds_levels(const StoredTexels& stored) {
  std::vector<StoredLevel> levels = empty_levels(stored);
  size_t chain = 0;
  for (StoredLevel& level : levels) {
    level.row_pitch = static_cast<size_t>(level.width) * texel_bytes(stored.texel);
    level.first = stored.first + chain;
    chain += level.row_pitch * static_cast<size_t>(level.height);
  }
  for (StoredLevel& level : levels) level.face_step = chain;
  return levels;
}

}  // namespace kiln::io

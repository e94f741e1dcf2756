// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "byte_cursor.h"
#include "format_numbers.h"
#include "gl_numbers.h"
#include "texture_files.h"

namespace kiln::io {
namespace {

[[noreturn]] void refuse(const std::string& reason) { throw Error(Fault::Input, reason); }

struct Extent {
  uint32_t width = 0;
  uint32_t height = 0;
  uint32_t depth = 0;
  uint32_t layers = 0;
  uint32_t faces = 0;
  uint32_t levels = 0;
};

Extent extent_of(ByteCursor& cursor) {
  Extent extent;
  extent.width = cursor.u32();
  extent.height = cursor.u32();
  extent.depth = cursor.u32();
  extent.layers = cursor.u32();
  extent.faces = cursor.u32();
  extent.levels = cursor.u32();
  return extent;
}

void apply(const Extent& extent, StoredTexels& stored) {
  stored.width = extent.width;
  stored.height = std::max(1u, extent.height);
  stored.depth = std::max(1u, extent.depth);
  stored.layers = std::max(1u, extent.layers);
  stored.faces = std::max(1u, extent.faces);
  stored.levels = std::max(1u, extent.levels);
}

// "KTXorientation" is "rd" in version 2 and "S=r,T=d" in version 1; u: the first row is the lowest.
void read_orientation(std::string_view text, StoredTexels& stored) {
  const size_t named = text.find("T=");
  const size_t at = named == std::string_view::npos ? 1 : named + 2;
  if (at < text.size() && text[at] == 'u') {
    stored.rows_from_below = true;
    stored.notes.emplace_back("rows were stored from the bottom; they were turned over");
  }
  if (text.starts_with('l') || text.find("S=l") != std::string_view::npos) {
    stored.notes.emplace_back("columns are stored from the right; they stay so");
  }
}

bool is_text(std::string_view value) {
  return std::all_of(value.begin(), value.end(), [](char c) {
    const auto byte = static_cast<uint8_t>(c);
    return byte >= 32 || byte == '\t' || byte == '\n' || byte == '\r';
  });
}

void read_keys(ByteCursor cursor, size_t length, StoredTexels& stored) {
  const size_t end = cursor.at() + std::min(length, cursor.left());
  while (cursor.at() + 4 <= end) {
    const uint32_t size = cursor.u32();
    if (size > end - cursor.at()) refuse("damaged: a key runs beyond its block");
    const std::string_view entry = cursor.text(size);
    cursor.skip((4 - size % 4) % 4);
    const size_t zero = entry.find('\0');
    if (zero == std::string_view::npos) continue;
    const std::string_view key = entry.substr(0, zero);
    std::string_view value = entry.substr(zero + 1);
    while (value.ends_with('\0')) value.remove_suffix(1);
    if (key == "KTXorientation") {
      read_orientation(value, stored);
    } else if (key == "KTXwriter") {
      stored.attributes.emplace_back("Software", value);
    } else if (!key.empty() && !key.starts_with("KTX") && is_text(value)) {
      stored.attributes.emplace_back(key, value);
    }
  }
}

std::string_view scheme_name(uint32_t scheme) {
  switch (scheme) {
    case 1:
      return "BasisLZ";
    case 3:
      return "ZLIB";
    default:
      return "an unknown scheme";
  }
}

}  // namespace

StoredTexels ktx1_texels(ByteView bytes) {
  ByteCursor cursor(bytes, 12);
  StoredTexels stored;
  const uint32_t mark = cursor.u32();
  stored.big_endian = mark == 0x01020304;
  if (mark != 0x04030201 && !stored.big_endian) refuse("damaged: no mark of its byte order");
  cursor.set_big_endian(stored.big_endian);
  const uint32_t type = cursor.u32();
  cursor.skip(4);
  const uint32_t format = cursor.u32();
  const uint32_t internal = cursor.u32();
  cursor.skip(4);
  if (type == 0) {
    refuse(fmt::format("texels of OpenGL format 0x{:x} are block-compressed, which is not read",
                       internal));
  }
  stored.format = "ktx";
  stored.texel = gl_texel(type, format);
  constexpr uint32_t srgb8 = 0x8c41, srgb8_alpha8 = 0x8c43;
  stored.texel.srgb = internal == srgb8 || internal == srgb8_alpha8;
  apply(extent_of(cursor), stored);
  const uint32_t key_bytes = cursor.u32();
  if (key_bytes > cursor.left()) refuse("truncated: the keys have no end");
  read_keys(cursor, key_bytes, stored);
  cursor.skip(key_bytes);
  cursor.skip(4);  // size of the level
  const size_t row = static_cast<size_t>(stored.width) * texel_bytes(stored.texel);
  stored.row_pitch = (row + 3) / 4 * 4;
  stored.first = cursor.at();
  return stored;
}

StoredTexels ktx2_texels(ByteView bytes) {
  ByteCursor cursor(bytes, 12);
  StoredTexels stored;
  stored.format = "ktx2";
  const uint32_t number = cursor.u32();
  cursor.skip(4);
  const Extent extent = extent_of(cursor);
  const uint32_t scheme = cursor.u32();
  constexpr uint32_t zstandard = 2;
  if (scheme == zstandard) stored.supercompression = Supercompression::Zstd;
  if (scheme != 0 && scheme != zstandard) {
    refuse(fmt::format("supercompressed with {}, which is not read; expected Zstandard or none",
                       scheme_name(scheme)));
  }
  const std::optional<TexelFormat> texel = vulkan_texel(number);
  if (!texel) {
    refuse(
        fmt::format("texels of VkFormat {} are not read, expected 8 or 16 bit, half, float or "
                    "packed ones without block compression",
                    number));
  }
  stored.texel = *texel;
  apply(extent, stored);
  cursor.skip(2 * 4);
  const uint32_t keys_at = cursor.u32();
  const uint32_t key_bytes = cursor.u32();
  cursor.skip(2 * 8);
  const uint64_t first = cursor.u64(), length = cursor.u64();
  if (keys_at > bytes.size() || key_bytes > bytes.size() - keys_at) {
    refuse("truncated: the keys have no end");
  }
  read_keys(ByteCursor(bytes, keys_at), key_bytes, stored);
  stored.row_pitch = static_cast<size_t>(stored.width) * texel_bytes(stored.texel);
  stored.first = static_cast<size_t>(std::min<uint64_t>(first, bytes.size()));
  stored.stored_bytes = length;
  return stored;
}

// Faces of a cube are aligned to 4 bytes each, and so is the level. Of arrays the size that stands
// before a level is that of all its images, of a cube that of one face.
std::vector<StoredLevel> ktx1_levels(const StoredTexels& stored, ByteView bytes) {
  std::vector<StoredLevel> levels = empty_levels(stored);
  const bool lone_cube = stored.faces > 1 && stored.layers == 1;
  size_t at = stored.first - 4;
  for (StoredLevel& level : levels) {
    ByteCursor cursor(bytes, at);
    cursor.set_big_endian(stored.big_endian);
    const size_t size = (size_t{cursor.u32()} + 3) / 4 * 4;
    level.row_pitch = (static_cast<size_t>(level.width) * texel_bytes(stored.texel) + 3) / 4 * 4;
    level.first = at + 4;
    level.face_step = lone_cube ? size : level.row_pitch * static_cast<size_t>(level.height);
    at = level.first + size * static_cast<size_t>(lone_cube ? stored.faces : 1);
  }
  return levels;
}

std::vector<StoredLevel> ktx2_levels(const StoredTexels& stored, ByteView bytes) {
  std::vector<StoredLevel> levels = empty_levels(stored);
  constexpr size_t index_at = 80;
  ByteCursor cursor(bytes, index_at);
  for (StoredLevel& level : levels) {
    level.first = static_cast<size_t>(std::min<uint64_t>(cursor.u64(), bytes.size()));
    level.stored_bytes = cursor.u64();
    cursor.skip(8);
    level.row_pitch = static_cast<size_t>(level.width) * texel_bytes(stored.texel);
    level.face_step = level.row_pitch * static_cast<size_t>(level.height);
  }
  return levels;
}

}  // namespace kiln::io

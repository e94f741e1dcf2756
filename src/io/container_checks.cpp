// SPDX-License-Identifier: Apache-2.0
#include "container_checks.h"

#include <algorithm>
#include <string_view>

namespace kiln::io {
namespace {

constexpr size_t png_signature_length = 8;
constexpr size_t png_chunk_frame = 12;  // length, name and checksum

uint32_t big_endian(ByteView bytes, size_t at) {
  return static_cast<uint32_t>(bytes[at]) << 24 | static_cast<uint32_t>(bytes[at + 1]) << 16 |
         static_cast<uint32_t>(bytes[at + 2]) << 8 | static_cast<uint32_t>(bytes[at + 3]);
}

uint32_t little_endian(ByteView bytes, size_t at) {
  return static_cast<uint32_t>(bytes[at + 3]) << 24 | static_cast<uint32_t>(bytes[at + 2]) << 16 |
         static_cast<uint32_t>(bytes[at + 1]) << 8 | static_cast<uint32_t>(bytes[at]);
}

std::string_view text_at(ByteView bytes, size_t at, size_t length) {
  return {reinterpret_cast<const char*>(bytes.data()) + at, length};
}

struct PngChunk {
  std::string_view name;
  ByteView content;
  ByteView behind;  // all that follows
};

/// Lets go of what was walked through, a piece at a time.
struct Walk {
  const LetGo& let_go;
  size_t next = FileContents::mapped_piece;

  void reach(size_t at) {
    if (at < next) return;
    let_go();
    next = at + FileContents::mapped_piece;
  }
};

// The chunk at the front, unless the bytes end within it.
std::optional<PngChunk> chunk_at(ByteView bytes) {
  if (bytes.size() < png_chunk_frame) return std::nullopt;
  const size_t length = big_endian(bytes, 0);
  if (length > bytes.size() - png_chunk_frame) return std::nullopt;
  return PngChunk{text_at(bytes, 4, 4), bytes.subspan(8, length),
                  bytes.subspan(length + png_chunk_frame)};
}

std::optional<PngChunk> first_chunk(ByteView bytes) {
  return chunk_at(bytes.subspan(std::min(png_signature_length, bytes.size())));
}

std::optional<PngChunk> next(const PngChunk& chunk) { return chunk_at(chunk.behind); }

// Samples of a texel by colour type: grey, colour, palette, and the two with alpha.
int png_samples(int color_type) {
  switch (color_type) {
    case 2:
      return 3;
    case 4:
      return 2;
    case 6:
      return 4;
    default:
      return 1;
  }
}

// gAMA holds 100000 / gamma of the encoding.
std::optional<std::string> space_of_gamma(uint32_t stored) {
  if (stored == 100000) return "lin_rec709_scene";
  if (stored > 45000 && stored < 46000) return "g22_rec709_scene";
  return std::nullopt;
}

std::string profile_name(ByteView content) {
  const std::string_view text = text_at(content, 0, content.size());
  return "icc: " + std::string(text.substr(0, text.find('\0')));
}

}  // namespace

std::optional<std::string> png_color_tag(ByteView bytes) {
  std::optional<std::string> tag;
  for (auto chunk = first_chunk(bytes); chunk && chunk->name != "IDAT"; chunk = next(*chunk)) {
    if (chunk->name == "sRGB") return "srgb_rec709_scene";
    if (chunk->name == "iCCP") tag = profile_name(chunk->content);
    if (chunk->name == "gAMA" && chunk->content.size() == 4 && !tag) {
      tag = space_of_gamma(big_endian(chunk->content, 0));
    }
  }
  return tag;
}

bool png_is_complete(ByteView bytes, const LetGo& let_go) {
  Walk walk{let_go};
  for (auto chunk = first_chunk(bytes); chunk; chunk = next(*chunk)) {
    if (chunk->name == "IEND") return true;
    walk.reach(bytes.size() - chunk->behind.size());
  }
  return false;
}

std::optional<PngHeader> png_header(ByteView bytes) {
  constexpr size_t width_at = 16;
  constexpr uint32_t largest = 0x7fffffff;
  if (bytes.size() < width_at + 10 || text_at(bytes, 12, 4) != "IHDR") return std::nullopt;
  const uint32_t width = big_endian(bytes, width_at);
  const uint32_t height = big_endian(bytes, width_at + 4);
  if (width > largest || height > largest) return std::nullopt;
  const int depth = bytes[width_at + 8];
  const int color_type = bytes[width_at + 9];
  return PngHeader{{static_cast<int>(width), static_cast<int>(height)},
                   depth * png_samples(color_type)};
}

bool png_may_hold_its_pixels(const PngHeader& header, size_t bytes) {
  constexpr double largest_ratio = 1032;
  const double pixels = static_cast<double>(area(header.size)) * header.bits_per_texel / 8;
  return pixels <= largest_ratio * static_cast<double>(bytes);
}

bool dds_may_hold_its_pixels(ByteView bytes) {
  constexpr size_t header_length = 128;
  constexpr size_t height_at = 12;
  if (bytes.size() < header_length) return false;
  const double texels = static_cast<double>(little_endian(bytes, height_at)) *
                        static_cast<double>(little_endian(bytes, height_at + 4));
  return texels > 0 && texels / 2 <= static_cast<double>(bytes.size() - header_length);
}

bool jpeg_is_complete(ByteView bytes, const LetGo& let_go) {
  constexpr uint8_t end_of_image = 0xd9;
  constexpr uint8_t start_of_scan = 0xda;
  const auto has_no_length = [](uint8_t marker) {
    return marker == 0 || marker == 1 || (marker >= 0xd0 && marker <= 0xd8) || marker == 0xff;
  };
  bool scan_seen = false;
  Walk walk{let_go};
  for (size_t at = 2; at + 1 < bytes.size();) {
    walk.reach(at);
    const uint8_t marker = bytes[at + 1];
    if (bytes[at] != 0xff || has_no_length(marker)) {
      // Between markers, in coded data (where ff is followed by 00), at a restart or a fill byte.
      ++at;
      continue;
    }
    if (marker == end_of_image) return scan_seen;
    scan_seen = scan_seen || marker == start_of_scan;
    if (at + 3 >= bytes.size()) return false;
    at += 2 + (static_cast<size_t>(bytes[at + 2]) << 8 | bytes[at + 3]);
  }
  return false;
}

}  // namespace kiln::io

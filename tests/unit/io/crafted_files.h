// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

/// Files built byte by byte, for what no writer of ours makes.
namespace kiln::test {

inline std::string big_endian(uint32_t value, int bytes) {
  std::string text;
  for (int shift = 8 * (bytes - 1); shift >= 0; shift -= 8) {
    text += static_cast<char>(value >> shift & 255);
  }
  return text;
}

inline std::string little_endian(uint32_t value, int bytes) {
  std::string text;
  for (int i = 0; i < bytes; ++i) text += static_cast<char>(value >> 8 * i & 255);
  return text;
}

inline uint32_t crc32(const std::string& text) {
  uint32_t crc = ~0u;
  for (const char c : text) {
    crc ^= static_cast<uint8_t>(c);
    for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ (crc & 1 ? 0xedb88320u : 0u);
  }
  return ~crc;
}

inline std::string png_chunk(const std::string& name, const std::string& content) {
  return big_endian(static_cast<uint32_t>(content.size()), 4) + name + content +
         big_endian(crc32(name + content), 4);
}

/// zlib's format with one stored block.
inline std::string stored_zlib(const std::string& content) {
  const auto size = static_cast<uint32_t>(content.size());
  uint32_t a = 1, b = 0;
  for (const char c : content) {
    a = (a + static_cast<uint8_t>(c)) % 65521;
    b = (b + a) % 65521;
  }
  return "\x78\x01\x01" + little_endian(size, 2) + little_endian(~size & 0xffff, 2) + content +
         big_endian(b << 16 | a, 4);
}

struct CraftedPng {
  int width = 1;
  int height = 1;
  int depth = 8;
  int color_type = 0;
  std::string before_pixels = {};      ///< whole chunks
  std::vector<std::string> rows = {};  ///< without the filter byte
};

inline std::string png(const CraftedPng& image) {
  std::string pixels;
  for (const std::string& row : image.rows) pixels += '\0' + row;
  const std::string header = big_endian(static_cast<uint32_t>(image.width), 4) +
                             big_endian(static_cast<uint32_t>(image.height), 4) +
                             static_cast<char>(image.depth) + static_cast<char>(image.color_type) +
                             std::string(3, '\0');
  return "\x89PNG\r\n\x1a\n" + png_chunk("IHDR", header) + image.before_pixels +
         png_chunk("IDAT", stored_zlib(pixels)) + png_chunk("IEND", "");
}

inline std::string tiff_entry(int tag, int type, uint32_t count, uint32_t value) {
  return little_endian(static_cast<uint32_t>(tag), 2) +
         little_endian(static_cast<uint32_t>(type), 2) + little_endian(count, 4) +
         little_endian(value, 4);
}

struct CraftedTiff {
  uint32_t width = 1;
  uint32_t height = 1;
  uint32_t samples = 1;
  uint32_t orientation = 1;
  int extra_sample = 0;     ///< 1 premultiplied alpha, 2 straight, 0 none
  std::string pixels = {};  ///< 8 bit
};

/// Little-endian, uncompressed, one strip behind the directory.
inline std::string tiff(const CraftedTiff& image) {
  constexpr int short_type = 3, long_type = 4;
  const bool rgb = image.samples >= 3;
  std::vector<std::string> entries{
      tiff_entry(256, long_type, 1, image.width), tiff_entry(257, long_type, 1, image.height),
      tiff_entry(258, short_type, 1, 8), tiff_entry(259, short_type, 1, 1),
      tiff_entry(262, short_type, 1, rgb ? 2 : 1)};
  const uint32_t count = image.extra_sample != 0 ? 11 : 10;
  const uint32_t pixels_at = 8 + 2 + count * 12 + 4;
  entries.push_back(tiff_entry(273, long_type, 1, pixels_at));
  entries.push_back(tiff_entry(274, short_type, 1, image.orientation));
  entries.push_back(tiff_entry(277, short_type, 1, image.samples));
  entries.push_back(tiff_entry(278, long_type, 1, image.height));
  entries.push_back(tiff_entry(279, long_type, 1, static_cast<uint32_t>(image.pixels.size())));
  if (image.extra_sample != 0) {
    entries.push_back(tiff_entry(338, short_type, 1, static_cast<uint32_t>(image.extra_sample)));
  }
  std::string file = std::string("II*\0", 4) + little_endian(8, 4) + little_endian(count, 2);
  for (const std::string& entry : entries) file += entry;
  return file + little_endian(0, 4) + image.pixels;
}

/// A JPEG with an EXIF segment of nothing but an orientation put behind its first marker.
inline std::string with_exif_orientation(const std::string& jpeg, uint32_t orientation) {
  const std::string exif = std::string("Exif\0\0II*\0", 10) + little_endian(8, 4) +
                           little_endian(1, 2) + tiff_entry(274, 3, 1, orientation) +
                           little_endian(0, 4);
  return jpeg.substr(0, 2) + "\xff\xe1" + big_endian(static_cast<uint32_t>(exif.size() + 2), 2) +
         exif + jpeg.substr(2);
}

}  // namespace kiln::test

// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <libdeflate.h>

#include <algorithm>
#include <cstring>
#include <memory>

#include "kiln/core/error.h"
#include "level_encoder.h"
#include "samples.h"
#include "stored_planes.h"
#include "tiff_description.h"
#include "tiff_directory.h"

namespace kiln::io {
namespace {

constexpr int tile_edge = 64;
constexpr int packing_level = 6;

// Of text.
constexpr std::pair<std::string_view, uint16_t> text_tags[] = {
    {"DocumentName", 269},    {"ImageDescription", 270}, {"Make", 271},       {"Model", 272},
    {"Software", 305},        {"DateTime", 306},         {"Artist", 315},     {"HostComputer", 316},
    {"textureformat", 33302}, {"wrapmodes", 33303},      {"Copyright", 33432}};

bool is_integer(PixelType type) { return type == PixelType::Uint8 || type == PixelType::Uint16; }

/// Tiles of a level: where they lie, and rows that make no tile yet.
struct TiledLevel {
  Size size;
  int first = 0, rows = 0;
  std::vector<std::byte> samples;  ///< [tile_edge][width][channels]
  std::vector<uint64_t> places, lengths;
};

struct Layout {
  size_t channels = 1;
  int alpha_channel = -1;
};

Layout layout_of(const std::vector<std::string>& names) {
  const Layers blank = make_layers({}, names);
  const StoredPlanes stored = in_file_order(blank);
  return {stored.planes.size(), stored.alpha_channel};
}

// Tiles are padded, and what does not pack may grow a little.
bool needs_big(const TextureToWrite& texture, size_t texel_bytes) {
  double bytes = 0;
  for (const Size size : texture.sizes) {
    bytes += (static_cast<double>(size.width) + tile_edge) * (size.height + tile_edge) *
             static_cast<double>(texel_bytes);
  }
  return bytes * 1.01 > 4.2e9;
}

/// Tiles of all levels as they come, the directories behind them.
/// @source Adobe, "TIFF 6.0", sections 8, 14, 15, 18; "TIFF Technical Notes" for Photoshop (half);
///         libtiff, tiff.h (Pixar's tags)
class TiffLevels : public LevelEncoder {
 public:
  explicit TiffLevels(const TextureToWrite& texture)
      : type_(texture.options.type),
        layout_(layout_of(texture.names)),
        texel_bytes_(layout_.channels * sample_bytes(type_)),
        tags_(as_tiff_tags(texture.options.attributes)),
        out_(texture.out),
        facts_(texture.facts),
        directories_(texture.out, needs_big(texture, texel_bytes_)),
        packer_(libdeflate_alloc_compressor(packing_level), libdeflate_free_compressor),
        tile_(texel_bytes_ * tile_edge * tile_edge),
        packed_(libdeflate_zlib_compress_bound(packer_.get(), tile_.size())) {
    for (const Size size : texture.sizes) levels_.emplace_back().size = size;
  }

  void add(int level, int, const Layers& rows) override {
    TiledLevel& tiled = levels_[static_cast<size_t>(level)];
    const StoredPlanes band = in_file_order(rows);
    const size_t row_bytes = static_cast<size_t>(tiled.size.width) * texel_bytes_;
    tiled.samples.resize(row_bytes * tile_edge);
    for (int y = 0; y < rows.size.height; ++y) {
      std::byte* to = tiled.samples.data() + static_cast<size_t>(tiled.rows) * row_bytes;
      for (size_t c = 0; c < band.planes.size(); ++c) {
        store_samples(band.planes[c]->texels_of_row(y), type_, band.planes.size(),
                      to + c * sample_bytes(type_), facts_);
      }
      ++tiled.rows;
      const bool last = tiled.first + tiled.rows == tiled.size.height;
      if (tiled.rows == tile_edge || last) write_tiles(tiled);
      if (last) tiled.samples = {};
    }
  }

  void finish() override {
    for (size_t l = 0; l < levels_.size(); ++l) {
      describe(levels_[l], l > 0);
      directories_.write();
    }
  }

 private:
  void write_tiles(TiledLevel& tiled) {
    for (int x = 0; x < tiled.size.width; x += tile_edge) {
      fill_tile(tiled, x);
      if (type_ == PixelType::Uint8) difference<uint8_t>();
      if (type_ == PixelType::Uint16) difference<uint16_t>();
      const size_t length = libdeflate_zlib_compress(packer_.get(), tile_.data(), tile_.size(),
                                                     packed_.data(), packed_.size());
      if (length == 0) throw Error(Fault::Internal, "a tile outgrew its bound");
      tiled.places.push_back(out_.position());
      tiled.lengths.push_back(length);
      out_.append({packed_.data(), length});
    }
    tiled.first += tiled.rows;
    tiled.rows = 0;
  }

  // Beyond the image there are zeros.
  void fill_tile(const TiledLevel& tiled, int x) {
    std::fill(tile_.begin(), tile_.end(), std::byte{0});
    const auto width = static_cast<size_t>(std::min(tile_edge, tiled.size.width - x));
    for (size_t y = 0; y < static_cast<size_t>(tiled.rows); ++y) {
      const size_t from = (y * static_cast<size_t>(tiled.size.width) + static_cast<size_t>(x));
      std::memcpy(tile_.data() + y * tile_edge * texel_bytes_,
                  tiled.samples.data() + from * texel_bytes_, width * texel_bytes_);
    }
  }

  // Each sample less the one of the texel before, which packs better.
  template <class Sample>
  void difference() {
    const size_t row = tile_edge * layout_.channels;
    std::vector<Sample> samples(row);
    for (size_t y = 0; y < tile_edge; ++y) {
      std::byte* at = tile_.data() + y * row * sizeof(Sample);
      std::memcpy(samples.data(), at, row * sizeof(Sample));
      for (size_t i = row; i-- > layout_.channels;) {
        samples[i] = static_cast<Sample>(samples[i] - samples[i - layout_.channels]);
      }
      std::memcpy(at, samples.data(), row * sizeof(Sample));
    }
  }

  void describe(const TiledLevel& tiled, bool reduced) {
    const bool color = layout_.channels >= 3;
    const auto bits = static_cast<uint16_t>(8 * sample_bytes(type_));
    const uint16_t whole_numbers = 1, floats = 3, deflate = 8;
    directories_.add_long(254, reduced ? 1 : 0);
    directories_.add_long(256, static_cast<uint32_t>(tiled.size.width));
    directories_.add_long(257, static_cast<uint32_t>(tiled.size.height));
    directories_.add_shorts(258, std::vector<uint16_t>(layout_.channels, bits));
    directories_.add_shorts(259, {deflate});
    directories_.add_shorts(262, {static_cast<uint16_t>(color ? 2 : 1)});  // RGB, or 0 is black
    directories_.add_shorts(274, {1});  // the first row is the upper one
    directories_.add_shorts(277, {static_cast<uint16_t>(layout_.channels)});
    directories_.add_shorts(284, {1});                         // channel by channel within a texel
    if (is_integer(type_)) directories_.add_shorts(317, {2});  // differences
    directories_.add_long(322, tile_edge);
    directories_.add_long(323, tile_edge);
    directories_.add_places(324, tiled.places);
    directories_.add_places(325, tiled.lengths);
    describe_extra(layout_.channels - (color ? 3 : 1));
    directories_.add_shorts(
        339, std::vector<uint16_t>(layout_.channels, is_integer(type_) ? whole_numbers : floats));
    for (const auto& [name, text] : tags_) {
      for (const auto& [known, tag] : text_tags) {
        if (known == name) directories_.add_text(tag, text);
      }
    }
  }

  // Channels beyond colour: alpha that is not multiplied in, or anything.
  void describe_extra(size_t count) {
    if (count == 0) return;
    constexpr uint16_t anything = 0, straight_alpha = 2;
    std::vector<uint16_t> kinds(count, anything);
    if (layout_.alpha_channel >= 0) {
      kinds[static_cast<size_t>(layout_.alpha_channel) - (layout_.channels - count)] =
          straight_alpha;
    }
    directories_.add_shorts(338, kinds);
  }

  PixelType type_;
  Layout layout_;
  size_t texel_bytes_;
  Attributes tags_;
  ByteStream& out_;
  WriteFacts& facts_;
  TiffDirectories directories_;
  std::unique_ptr<libdeflate_compressor, void (*)(libdeflate_compressor*)> packer_;
  std::vector<std::byte> tile_;
  std::vector<char> packed_;
  std::vector<TiledLevel> levels_;
};

}  // namespace

std::unique_ptr<LevelEncoder> tiff_levels(const TextureToWrite& texture) {
  return std::make_unique<TiffLevels>(texture);
}

}  // namespace kiln::io

// SPDX-License-Identifier: Apache-2.0
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIntAttribute.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfTiledOutputFile.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>

#include "kiln/core/error.h"
#include "kiln/image/mip_levels.h"
#include "level_encoder.h"
#include "openexr_header.h"
#include "openexr_stream.h"
#include "openexr_texture.h"
#include "samples.h"

namespace kiln::io {
namespace {

constexpr int tile_edge = 64;

[[noreturn]] void refuse(const std::string& reason) { throw Error(Fault::Usage, reason); }

// A cube's faces stand one below the other, and all of that is halved.
void check_shape(const Texture& texture, Samples samples) {
  const Size size = texture.levels.front().front().size;
  if (!texture.is_cube()) {
    if (samples == Samples::Nodes && size.width != 2 * size.height) {
      refuse(
          fmt::format("found {} x {} texels; an environment with samples at nodes is twice as "
                      "wide as high",
                      size.width, size.height));
    }
    return;
  }
  if (samples != Samples::Nodes) {
    refuse("openexr holds cubes with samples at nodes, these are at texel centres");
  }
  for (size_t l = 0; l < texture.levels.size(); ++l) {
    if ((6 * size.height) >> l != 6 * texture.levels[l].front().size.height) {
      refuse(
          fmt::format("{} levels of a cube with faces of {} texels; openexr halves the six "
                      "together, so that the size must halve evenly",
                      texture.levels.size(), size.width));
    }
  }
}

Imf::Header header_of(const TextureToWrite& texture) {
  Imf::Header header(texture.sizes.front().width, texture.sizes.front().height);
  header.compression() = Imf::ZIP_COMPRESSION;
  header.setTileDescription(
      Imf::TileDescription(tile_edge, tile_edge, Imf::MIPMAP_LEVELS, Imf::ROUND_DOWN));
  add_channels(texture.names, texture.options.type, header);
  header.insert(own_levels_name, Imf::IntAttribute(static_cast<int>(texture.sizes.size())));
  add_attributes(texture.options.attributes, header);
  return header;
}

/// Rows of a level until they make tiles.
struct Block {
  int first = 0, rows = 0;
  std::vector<std::byte> samples;  ///< [channels][tile_edge][width]
};

/// Tiles of all levels that the format demands, down to 1 x 1: what the texture lacks is averaged
/// from its last level.
class TileWriter : public LevelEncoder {
 public:
  TileWriter(const TextureToWrite& texture, const Imf::Header& header)
      : names_(texture.names),
        type_(texture.options.type),
        own_levels_(texture.sizes.size()),
        sizes_(level_sizes(texture.sizes.front())),
        blocks_(sizes_.size()),
        facts_(texture.facts),
        rest_({sizes_.begin() + static_cast<std::ptrdiff_t>(own_levels_ - 1), sizes_.end()},
              static_cast<int>(names_.size())),
        stream_(texture.path.string(), texture.out) {
    writing_openexr([&] { output_.emplace(stream_, header, 0); });
  }

  void add(int level, int first, const Layers& rows) override {
    for (int y = 0; y < rows.size.height; ++y) {
      add_row(level, facts_, [&](size_t c) { return rows.layers[c].plane.texels_of_row(y); });
    }
    if (static_cast<size_t>(level) + 1 == own_levels_) add_rest(first, rows);
  }

  // The library writes its table of offsets as the output ends.
  void finish() override { output_.reset(); }

 private:
  size_t row_bytes(int level) const {
    return static_cast<size_t>(sizes_[level].width) * sample_bytes(type_);
  }

  template <class Row>
  void add_row(int level, WriteFacts& facts, Row row) {
    Block& block = blocks_[level];
    const size_t bytes = row_bytes(level);
    block.samples.resize(names_.size() * tile_edge * bytes);
    for (size_t c = 0; c < names_.size(); ++c) {
      const size_t at = c * tile_edge + static_cast<size_t>(block.rows);
      store_samples(row(c), type_, 1, block.samples.data() + at * bytes, facts);
    }
    ++block.rows;
    const bool last = block.first + block.rows == sizes_[level].height;
    if (block.rows == tile_edge || last) write(level, block);
    if (last) block.samples = {};
  }

  void add_rest(int first, const Layers& rows) {
    const auto made = rest_.add(rows.size.height, [&](int y, float* const* channels) {
      for (size_t c = 0; c < names_.size(); ++c) {
        const auto row = rows.layers[c].plane.texels_of_row(y - first);
        std::copy(row.begin(), row.end(), channels[c]);
      }
    });
    WriteFacts ignored;  // averages of what was counted already
    for (const LevelRows& level : made) {
      for (int y = 0; y < level.rows(); ++y) {
        add_row(static_cast<int>(own_levels_) - 1 + level.level, ignored,
                [&](size_t c) { return level.planes[c].texels_of_row(y); });
      }
    }
  }

  void write(int level, Block& block) {
    Imf::FrameBuffer frame;
    for (size_t c = 0; c < names_.size(); ++c) {
      frame.insert(names_[c],
                   Imf::Slice::Make(library_type(type_),
                                    block.samples.data() + c * tile_edge * row_bytes(level),
                                    Imath::V2i(0, block.first), sizes_[level].width, tile_edge,
                                    sample_bytes(type_), row_bytes(level)));
    }
    writing_openexr([&] {
      output_->setFrameBuffer(frame);
      const int y = block.first / tile_edge;
      output_->writeTiles(0, output_->numXTiles(level) - 1, y, y, level);
    });
    block.first += block.rows;
    block.rows = 0;
  }

  std::vector<std::string> names_;
  PixelType type_;
  size_t own_levels_;
  std::vector<Size> sizes_;
  std::vector<Block> blocks_;  ///< of each level
  WriteFacts& facts_;
  MipCascade rest_;
  ExrStream stream_;
  std::optional<Imf::TiledOutputFile> output_;
};

Layers level_image(const std::vector<Layers>& level) {
  return level.size() == 6 ? stacked_faces(level) : level.front();
}

}  // namespace

std::unique_ptr<LevelEncoder> openexr_levels(const TextureToWrite& texture) {
  Imf::Header header = header_of(texture);
  header.lineOrder() = Imf::RANDOM_Y;  // tiles lie as they come
  return std::make_unique<TileWriter>(texture, header);
}

void write_openexr_texture(const Texture& texture, const TextureWriteOptions& options,
                           ByteStream& out, WriteFacts& facts) {
  check_shape(texture, options.samples);
  std::vector<Size> sizes;
  for (const std::vector<Layers>& level : texture.levels) {
    const Size face = level.front().size;
    sizes.push_back({face.width, face.height * static_cast<int>(level.size())});
  }
  std::vector<std::string> names;
  for (const Layer& layer : texture.levels.front().front().layers) names.push_back(layer.name);
  const TextureToWrite file{"texture", sizes, names, options, out, facts};
  Imf::Header header = header_of(file);
  if (options.samples == Samples::Nodes) {
    Imf::addEnvmap(header, texture.is_cube() ? Imf::ENVMAP_CUBE : Imf::ENVMAP_LATLONG);
  }
  TileWriter writer(file, header);
  for (size_t l = 0; l < texture.levels.size(); ++l) {
    writer.add(static_cast<int>(l), 0, level_image(texture.levels[l]));
  }
  writer.finish();
}

}  // namespace kiln::io

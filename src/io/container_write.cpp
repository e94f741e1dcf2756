// SPDX-License-Identifier: Apache-2.0
#include "container_write.h"

#include <string>
#include <vector>

#include "byte_text.h"
#include "level_encoder.h"
#include "stored_planes.h"
#include "table_files.h"
#include "texel_pack.h"
#include "zstd_bytes.h"

namespace kiln::io {
namespace {

// Three channels of whole samples get a fourth, which is what graphics libraries have formats for.
int stored_channels(size_t layers, PixelType type) {
  const auto count = static_cast<int>(layers);
  if (type == PixelType::B10g11r11 || type == PixelType::E5b9g9r9) return 3;
  return count == 3 ? 4 : count;
}

Contents contents_of(const Texture& texture, PixelType type) {
  const std::vector<Layers>& largest = texture.levels.front();
  return {.slice = largest.front().size,
          .channels = stored_channels(largest.front().layers.size(), type),
          .faces = static_cast<int>(largest.size()),
          .levels = static_cast<int>(texture.levels.size())};
}

std::string face_texels(const Layers& face, const Contents& contents, PixelType type,
                        WriteFacts& facts) {
  return packed_texels(face.size, in_file_order(face), contents.channels, type, facts);
}

size_t level_bytes(const std::vector<Layers>& level, const Contents& contents, PixelType type) {
  return static_cast<size_t>(area(level.front().size)) * level.size() *
         packed_texel_bytes(type, contents.channels);
}

void align(ByteStream& out, size_t step) {
  const size_t over = out.position() % step;
  if (over != 0) out.append(std::string(step - over, '\0'));
}

Ktx2Description description_of(const TextureWriteOptions& options) {
  return {options.attributes, options.color_tag, options.supercompression};
}

void write_ktx2(const Texture& texture, const TextureWriteOptions& options, ByteStream& out,
                WriteFacts& facts) {
  const Contents contents = contents_of(texture, options.type);
  std::vector<LevelBytes> sizes;
  for (const std::vector<Layers>& level : texture.levels) {
    const size_t bytes = level_bytes(level, contents, options.type);
    sizes.push_back({bytes, bytes});
  }
  out.append(ktx2_header(contents, options.type, description_of(options), sizes));
  const size_t step = ktx2_alignment(contents, options.type, options.supercompression);
  for (size_t l = texture.levels.size(); l-- > 0;) {
    align(out, step);
    for (const Layers& face : texture.levels[l]) {
      out.append(face_texels(face, contents, options.type, facts));
    }
  }
}

// How long the levels are is known once they are packed.
void write_packed_ktx2(const Texture& texture, const TextureWriteOptions& options, ByteStream& out,
                       WriteFacts& facts) {
  const Contents contents = contents_of(texture, options.type);
  std::vector<std::string> levels;
  std::vector<LevelBytes> sizes;
  for (const std::vector<Layers>& level : texture.levels) {
    std::string texels;
    for (const Layers& face : level) texels += face_texels(face, contents, options.type, facts);
    levels.push_back(zstd_compressed(texels));
    sizes.push_back({levels.back().size(), texels.size()});
  }
  out.append(ktx2_header(contents, options.type, description_of(options), sizes));
  for (size_t l = levels.size(); l-- > 0;) out.append(levels[l]);
}

void write_dds(const Texture& texture, const TextureWriteOptions& options, ByteStream& out,
               WriteFacts& facts) {
  const Contents contents = contents_of(texture, options.type);
  const size_t largest = static_cast<size_t>(area(contents.slice)) *
                         packed_texel_bytes(options.type, contents.channels);
  out.append(dds_header(contents, options.type, largest));
  for (size_t face = 0; face < static_cast<size_t>(contents.faces); ++face) {
    for (const std::vector<Layers>& level : texture.levels) {
      out.append(face_texels(level[face], contents, options.type, facts));
    }
  }
}

// Rows begin at multiples of 4 bytes, as OpenGL unpacks them by default.
std::string with_row_padding(std::string texels, int height) {
  const size_t row = texels.size() / static_cast<size_t>(height);
  if (row % 4 == 0) return texels;
  std::string padded;
  for (size_t at = 0; at < texels.size(); at += row) {
    padded.append(texels, at, row);
    pad_to(padded, 4);
  }
  return padded;
}

// With such rows neither faces nor levels need a padding of their own. The size before a level is
// that of one face where the texture is a cube.
void write_ktx1(const Texture& texture, const TextureWriteOptions& options, ByteStream& out,
                WriteFacts& facts) {
  const Contents contents = contents_of(texture, options.type);
  out.append(ktx1_header(contents, options.type, options.attributes));
  for (const std::vector<Layers>& level : texture.levels) {
    for (size_t f = 0; f < level.size(); ++f) {
      const std::string texels = with_row_padding(
          face_texels(level[f], contents, options.type, facts), level[f].size.height);
      std::string size;
      append_little(size, texels.size(), 4);
      if (f == 0) out.append(size);
      out.append(texels);
    }
  }
}

// A texture of one image whose levels have their places from the start.
class PlacedLevels : public LevelEncoder {
 public:
  PlacedLevels(std::string_view format, const TextureToWrite& texture)
      : type_(texture.options.type), out_(texture.out), facts_(texture.facts) {
    contents_.slice = texture.sizes.front();
    contents_.channels = stored_channels(texture.names.size(), type_);
    contents_.levels = static_cast<int>(texture.sizes.size());
    contents_.srgb = texture.options.color_tag == ColorTag::Srgb && type_ == PixelType::Uint8;
    for (const Size size : texture.sizes) {
      row_bytes_.push_back(static_cast<size_t>(size.width) *
                           packed_texel_bytes(type_, contents_.channels));
      const size_t bytes = row_bytes_.back() * static_cast<size_t>(size.height);
      levels_.push_back({bytes, bytes});
    }
    if (format == "dds") {
      place_dds();
    } else {
      place_ktx2(texture.options);
    }
  }

  void add(int level, int first, const Layers& rows) override {
    const auto l = static_cast<size_t>(level);
    out_.seek(places_[l] + row_bytes_[l] * static_cast<size_t>(first));
    out_.append(face_texels(rows, contents_, type_, facts_));
  }

  void finish() override {}

 private:
  void place_dds() {
    const std::string header = dds_header(contents_, type_, levels_.front().texels);
    size_t place = header.size();
    for (const LevelBytes& level : levels_) {
      places_.push_back(place);
      place += level.stored;
    }
    out_.append(header);
  }

  void place_ktx2(const TextureWriteOptions& options) {
    const std::string header = ktx2_header(contents_, type_, description_of(options), levels_);
    const size_t step = ktx2_alignment(contents_, type_, Supercompression::None);
    size_t place = header.size();
    places_.resize(levels_.size());
    for (size_t l = levels_.size(); l-- > 0;) {
      places_[l] = (place + step - 1) / step * step;
      place = places_[l] + levels_[l].stored;
    }
    out_.append(header);
  }

  Contents contents_;
  PixelType type_;
  ByteStream& out_;
  WriteFacts& facts_;
  std::vector<size_t> row_bytes_, places_;  ///< of each level
  std::vector<LevelBytes> levels_;
};

}  // namespace

std::unique_ptr<LevelEncoder> container_levels(std::string_view format,
                                               const TextureToWrite& texture) {
  return std::make_unique<PlacedLevels>(format, texture);
}

void write_container(std::string_view format, const Texture& texture,
                     const TextureWriteOptions& options, ByteStream& out, WriteFacts& facts) {
  const bool packs = options.supercompression == Supercompression::Zstd;
  if (format == "dds") return write_dds(texture, options, out, facts);
  if (format == "ktx") return write_ktx1(texture, options, out, facts);
  if (packs) return write_packed_ktx2(texture, options, out, facts);
  write_ktx2(texture, options, out, facts);
}

}  // namespace kiln::io

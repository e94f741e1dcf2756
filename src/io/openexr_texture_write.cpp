// SPDX-License-Identifier: Apache-2.0
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIntAttribute.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfTiledOutputFile.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <string>

#include "kiln/core/error.h"
#include "openexr_header.h"
#include "openexr_stream.h"
#include "openexr_texture.h"
#include "samples.h"

namespace kiln::io {
namespace {

constexpr unsigned tile_edge = 64;

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

// Each texel the mean of the two by two that it covers.
Plane halved(const Plane& plane) {
  const Size size{std::max(1, plane.width() / 2), std::max(1, plane.height() / 2)};
  Plane result(size);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const int right = std::min(2 * x + 1, plane.width() - 1);
      const int below = std::min(2 * y + 1, plane.height() - 1);
      result.at(x, y) = 0.25f * (plane.at(2 * x, 2 * y) + plane.at(right, 2 * y) +
                                 plane.at(2 * x, below) + plane.at(right, below));
    }
  }
  return result;
}

Layers halved(const Layers& image) {
  Layers result;
  for (const Layer& layer : image.layers)
    result.layers.push_back({layer.name, halved(layer.plane)});
  result.size = result.layers.front().plane.size();
  return result;
}

Imf::Header header_of(const Layers& largest, const Texture& texture,
                      const TextureWriteOptions& options) {
  Imf::Header header(largest.size.width, largest.size.height);
  header.compression() = Imf::ZIP_COMPRESSION;
  header.setTileDescription(
      Imf::TileDescription(tile_edge, tile_edge, Imf::MIPMAP_LEVELS, Imf::ROUND_DOWN));
  std::vector<std::string> names;
  for (const Layer& layer : largest.layers) names.push_back(layer.name);
  add_channels(names, options.type, header);
  if (options.samples == Samples::Nodes) {
    Imf::addEnvmap(header, texture.is_cube() ? Imf::ENVMAP_CUBE : Imf::ENVMAP_LATLONG);
  }
  header.insert(own_levels_name, Imf::IntAttribute(static_cast<int>(texture.levels.size())));
  add_attributes(options.attributes, header);
  return header;
}

// Samples of one level as they are stored, and where the library finds them.
void write_level(Imf::TiledOutputFile& file, const Layers& image, int level, PixelType type,
                 WriteFacts& facts) {
  const auto width = static_cast<size_t>(image.size.width);
  const size_t row_bytes = width * sample_bytes(type);
  const size_t plane_bytes = row_bytes * static_cast<size_t>(image.size.height);
  std::vector<std::byte> samples(plane_bytes * image.layers.size());
  Imf::FrameBuffer frame;
  for (size_t c = 0; c < image.layers.size(); ++c) {
    std::byte* at = samples.data() + c * plane_bytes;
    for (int y = 0; y < image.size.height; ++y) {
      store_samples(image.layers[c].plane.texels_of_row(y), type, 1,
                    at + static_cast<size_t>(y) * row_bytes, facts);
    }
    frame.insert(image.layers[c].name, Imf::Slice(library_type(type), reinterpret_cast<char*>(at),
                                                  sample_bytes(type), row_bytes));
  }
  file.setFrameBuffer(frame);
  file.writeTiles(0, file.numXTiles(level) - 1, 0, file.numYTiles(level) - 1, level);
}

Layers level_image(const std::vector<Layers>& level) {
  return level.size() == 6 ? stacked_faces(level) : level.front();
}

}  // namespace

void write_openexr_texture(const Texture& texture, const TextureWriteOptions& options,
                           ByteStream& out, WriteFacts& facts) {
  check_shape(texture, options.samples);
  Layers image = level_image(texture.levels.front());
  const Imf::Header header = header_of(image, texture, options);
  ExrStream stream("texture", out);
  writing_openexr([&] {
    Imf::TiledOutputFile file(stream, header, 0);
    for (int level = 0; level < file.numLevels(); ++level) {
      const auto l = static_cast<size_t>(level);
      const bool own = l < texture.levels.size();
      if (level > 0) image = own ? level_image(texture.levels[l]) : halved(image);
      WriteFacts ignored;  // averages of what was counted already
      write_level(file, image, level, options.type, own ? facts : ignored);
    }
  });
}

}  // namespace kiln::io

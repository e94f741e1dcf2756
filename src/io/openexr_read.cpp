// SPDX-License-Identifier: Apache-2.0
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfIntAttribute.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfThreading.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <iterator>
#include <utility>

#include "kiln/core/error.h"
#include "openexr_file.h"
#include "samples.h"

namespace kiln::io {
namespace {

using Imath::Box2i;

// Inclusive window -> extent, without overflow for any pair of corners.
long long extent(int min, int max) { return static_cast<long long>(max) - min + 1; }

// The library's own threads stay off, so that the limit on our threads bounds the process; and its
// headers may not claim sizes whose tables alone would fill the memory.
void bound_library() {
  static const bool bounded = [] {
    constexpr int longest_edge = 1 << 20;
    constexpr int longest_tile_edge = 1 << 14;
    Imf::setGlobalThreadCount(0);
    Imf::Header::setMaxImageSize(longest_edge, longest_edge);
    Imf::Header::setMaxTileSize(longest_tile_edge, longest_tile_edge);
    return true;
  }();
  static_cast<void>(bounded);
}

// The library's reason, without the path that it puts in front: 'Cannot open image file "x.exr".
// ...'
std::string reason_of(const std::exception& error) {
  const std::string text = error.what();
  const size_t quoted = text.find("\". ");
  return quoted == std::string::npos ? text : text.substr(quoted + 3);
}

// Everything that the library throws becomes an error of the input.
template <class Work>
auto translated(Work&& work) {
  try {
    return work();
  } catch (const Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw Error(Fault::Input, "damaged OpenEXR file, or too large for memory");
  } catch (const std::exception& error) {
    throw Error(Fault::Input, fmt::format("damaged OpenEXR file: {}", reason_of(error)));
  }
}

bool close_to(const Imath::V2f& a, const Imath::V2f& b) { return (a - b).length() < 1e-3f; }

bool same_primaries(const Imf::Chromaticities& a, const Imf::Chromaticities& b) {
  return close_to(a.red, b.red) && close_to(a.green, b.green) && close_to(a.blue, b.blue) &&
         close_to(a.white, b.white);
}

// Primaries and white of ACES: SMPTE ST 2065-1 (AP0) and Academy S-2014-004 (AP1).
std::optional<std::string> space_of(const Imf::Chromaticities& found) {
  const Imath::V2f white(0.32168f, 0.33767f);
  const Imf::Chromaticities ap0({0.7347f, 0.2653f}, {0.0f, 1.0f}, {0.0001f, -0.077f}, white);
  const Imf::Chromaticities ap1({0.713f, 0.293f}, {0.165f, 0.83f}, {0.128f, 0.044f}, white);
  if (same_primaries(found, Imf::Chromaticities())) return "lin_rec709_scene";
  if (same_primaries(found, ap0)) return "lin_ap0_scene";
  if (same_primaries(found, ap1)) return "lin_ap1_scene";
  return std::nullopt;
}

void note_chromaticities(const Imf::Header& header, FileFacts& facts) {
  if (!Imf::hasChromaticities(header)) return;
  const Imf::Chromaticities& c = Imf::chromaticities(header);
  facts.color_space_tag = space_of(c);
  if (facts.color_space_tag == "lin_rec709_scene") return;
  facts.notes.push_back(fmt::format(
      "chromaticities are not Rec.709: red {} {}, green {} {}, blue {} {}, white {} {}", c.red.x,
      c.red.y, c.green.x, c.green.y, c.blue.x, c.blue.y, c.white.x, c.white.y));
}

void note_environment(const Imf::Header& header, FileFacts& facts) {
  const auto* border = header.findTypedAttribute<Imf::IntAttribute>("oiio:sampleborder");
  facts.node_aligned = border != nullptr && border->value() == 1;
  if (!Imf::hasEnvmap(header)) return;
  facts.node_aligned = true;
  if (Imf::envmap(header) == Imf::ENVMAP_LATLONG) {
    facts.envmap = Envmap::LatLong;
    facts.notes.emplace_back("lat-long environment with samples on the border (envmap)");
  } else {
    facts.envmap = Envmap::Cube;
    facts.notes.emplace_back(
        "cube environment of six faces, one above the other, with samples on their borders "
        "(envmap)");
  }
}

void note_windows(const Imf::Header& header, FileFacts& facts) {
  const Box2i& shown = header.displayWindow();
  const Box2i& stored = header.dataWindow();
  if (shown == stored) return;
  facts.notes.push_back(fmt::format(
      "data window ({}, {})-({}, {}) differs from display window ({}, {})-({}, {}), which is "
      "returned, 0 where there is no data",
      stored.min.x, stored.min.y, stored.max.x, stored.max.y, shown.min.x, shown.min.y, shown.max.x,
      shown.max.y));
}

bool by_rank(const std::string& a, const std::string& b) {
  return channel_rank(a) < channel_rank(b);
}

void list_channels(const Imf::Header& header, FileFacts& facts) {
  facts.type = PixelType::Half;
  for (auto c = header.channels().begin(); c != header.channels().end(); ++c) {
    const Imf::Channel& channel = c.channel();
    if (channel.xSampling != 1 || channel.ySampling != 1) {
      throw Error(Fault::Input,
                  fmt::format("channel '{}' is subsampled {} x {}; expected every texel", c.name(),
                              channel.xSampling, channel.ySampling));
    }
    if (channel.type != Imf::HALF) facts.type = PixelType::Float;
    if (channel.type == Imf::UINT) {
      facts.notes.push_back(fmt::format("channel '{}' holds whole numbers", c.name()));
    }
    facts.channels.emplace_back(c.name());
  }
  std::stable_sort(facts.channels.begin(), facts.channels.end(), by_rank);
}

FileFacts facts_of(Imf::MultiPartInputFile& file, const ReadLimits& limits) {
  const Imf::Header& header = file.header(0);
  if (header.hasType() && Imf::isDeepData(header.type())) {
    throw Error(Fault::Input, "holds deep data, expected flat pixels");
  }
  FileFacts facts;
  facts.format = "openexr";
  list_channels(header, facts);
  const Box2i& shown = header.displayWindow();
  const Box2i& stored = header.dataWindow();
  const auto channels = static_cast<long long>(facts.channels.size());
  for (const Box2i& window : {shown, stored}) {
    require_within(limits, extent(window.min.x, window.max.x), extent(window.min.y, window.max.y),
                   channels);
  }
  facts.size = {shown.max.x - shown.min.x + 1, shown.max.y - shown.min.y + 1};
  if (file.parts() > 1) {
    facts.notes.push_back(fmt::format("has {} parts; the first is read", file.parts()));
  }
  note_windows(header, facts);
  note_chromaticities(header, facts);
  note_environment(header, facts);
  for (auto a = header.begin(); a != header.end(); ++a) {
    const auto* text = dynamic_cast<const Imf::StringAttribute*>(&a.attribute());
    if (text != nullptr) facts.attributes.emplace_back(a.name(), text->value());
  }
  return facts;
}

// Rows [first, first + rows) of the data window, each channel a plane of its own.
struct Block {
  int first = 0;
  int rows = 0;
  int width = 0;
  std::vector<float> texels;

  float* row(size_t channel, int y) {
    return texels.data() + (channel * static_cast<size_t>(rows) + static_cast<size_t>(y - first)) *
                               static_cast<size_t>(width);
  }
};

void read_block(Imf::InputPart& part, const std::vector<std::string>& channels, Block& block) {
  Imf::FrameBuffer frame;
  const Imath::V2i origin(part.header().dataWindow().min.x, block.first);
  for (size_t c = 0; c < channels.size(); ++c) {
    frame.insert(channels[c], Imf::Slice::Make(Imf::FLOAT, block.row(c, block.first), origin,
                                               block.width, block.rows));
  }
  part.setFrameBuffer(frame);
  part.readPixels(block.first, block.first + block.rows - 1);
}

// The part of a block that lies in the display window.
void place_block(Block& block, const Box2i& stored, const Box2i& shown, Layers& image) {
  const int left = std::max(stored.min.x, shown.min.x);
  const int right = std::min(stored.max.x, shown.max.x);
  if (left > right) return;
  for (int y = std::max(block.first, shown.min.y);
       y <= std::min(block.first + block.rows - 1, shown.max.y); ++y) {
    for (size_t c = 0; c < image.layers.size(); ++c) {
      const float* from = block.row(c, y) + (left - stored.min.x);
      std::copy_n(from, right - left + 1,
                  image.layers[c].plane.row(y - shown.min.y) + (left - shown.min.x));
    }
  }
}

// Whole rows of tiles, or of compressed lines, so that nothing is decoded twice.
int rows_of_block(const Imf::Header& header) {
  constexpr int lines = 64;
  return header.hasTileDescription() ? static_cast<int>(header.tileDescription().ySize) : lines;
}

// Planes are made once the first block could be read, so a header that promises much and has
// nothing behind it costs little.
Layers read_part(Imf::InputPart& part, Size size, const std::vector<std::string>& channels) {
  const Box2i stored = part.header().dataWindow();
  const Box2i shown = part.header().displayWindow();
  Block block{stored.min.y, 0, stored.max.x - stored.min.x + 1, {}};
  const int rows = rows_of_block(part.header());
  Layers image;
  while (block.first <= stored.max.y) {
    block.rows = static_cast<int>(std::min<long long>(rows, extent(block.first, stored.max.y)));
    block.texels.resize(channels.size() * static_cast<size_t>(block.rows) *
                        static_cast<size_t>(block.width));
    read_block(part, channels, block);
    if (image.layers.empty()) image = make_layers(size, channels);
    place_block(block, stored, shown, image);
    if (extent(block.first, stored.max.y) <= block.rows) break;
    block.first += block.rows;
  }
  return image;
}

bool covers_part(const Layers& image) {
  const Plane* alpha = image.find("A");
  if (alpha == nullptr) return false;
  for (int y = 0; y < alpha->height(); ++y) {
    for (const float a : alpha->texels_of_row(y)) {
      if (a != 1.0f) return true;
    }
  }
  return false;
}

}  // namespace

FileFacts inspect_openexr(const std::filesystem::path& path, const ReadLimits& limits) {
  bound_library();
  return translated([&] {
    Imf::MultiPartInputFile file(path.c_str(), 0, false);
    return facts_of(file, limits);
  });
}

ImageFile read_openexr(const std::filesystem::path& path, const Reading& reading) {
  bound_library();
  return translated([&] {
    Imf::MultiPartInputFile file(path.c_str(), 0, false);
    ImageFile result;
    result.facts = facts_of(file, reading.limits);
    if (!file.partComplete(0)) throw Error(Fault::Input, "truncated OpenEXR file");
    Imf::InputPart part(file, 0);
    std::vector<std::string> wanted;
    std::copy_if(result.facts.channels.begin(), result.facts.channels.end(),
                 std::back_inserter(wanted),
                 [&](const std::string& channel) { return reading.wants(channel); });
    result.image = read_part(part, result.facts.size, wanted);
    if (covers_part(result.image)) {
      result.facts.notes.emplace_back("alpha is not 1 everywhere; colour is as stored beside it");
    }
    return result;
  });
}

}  // namespace kiln::io

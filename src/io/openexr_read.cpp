// SPDX-License-Identifier: Apache-2.0
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfMultiPartInputFile.h>

#include <algorithm>
#include <utility>

#include "kiln/core/error.h"
#include "openexr_facts.h"
#include "openexr_file.h"

namespace kiln::io {
namespace {

using Imath::Box2i;

// Rows [first, first + rows) of the data window, all channels, each a plane of its own.
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

void read_block(Imf::InputPart& part, const FileFacts& facts, Block& block) {
  Imf::FrameBuffer frame;
  const Imath::V2i origin(part.header().dataWindow().min.x, block.first);
  for (size_t c = 0; c < facts.channels.size(); ++c) {
    frame.insert(facts.channels[c], Imf::Slice::Make(Imf::FLOAT, block.row(c, block.first), origin,
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
Layers read_part(Imf::InputPart& part, const FileFacts& facts) {
  const Box2i stored = part.header().dataWindow();
  const Box2i shown = part.header().displayWindow();
  Block block{stored.min.y, 0, stored.max.x - stored.min.x + 1, {}};
  const int rows = rows_of_block(part.header());
  Layers image;
  while (block.first <= stored.max.y) {
    block.rows = static_cast<int>(std::min<long long>(rows, extent(block.first, stored.max.y)));
    block.texels.resize(facts.channels.size() * static_cast<size_t>(block.rows) *
                        static_cast<size_t>(block.width));
    read_block(part, facts, block);
    if (image.layers.empty()) image = make_layers(facts.size, facts.channels);
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
  return reading_openexr([&] {
    Imf::MultiPartInputFile file(path.c_str(), 0, false);
    return openexr_facts(file, Reading::Image, limits);
  });
}

ImageFile read_openexr(const std::filesystem::path& path, const ReadLimits& limits) {
  return reading_openexr([&] {
    Imf::MultiPartInputFile file(path.c_str(), 0, false);
    ImageFile result;
    result.facts = openexr_facts(file, Reading::Image, limits);
    if (!file.partComplete(0)) throw Error(Fault::Input, "truncated OpenEXR file");
    Imf::InputPart part(file, 0);
    result.image = read_part(part, result.facts);
    if (covers_part(result.image)) {
      result.facts.notes.emplace_back("alpha is not 1 everywhere; colour is as stored beside it");
    }
    return result;
  });
}

}  // namespace kiln::io

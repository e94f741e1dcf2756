// SPDX-License-Identifier: Apache-2.0
#include <OpenEXR/ImfCompression.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfMultiPartInputFile.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "kiln/core/error.h"
#include "openexr_facts.h"
#include "openexr_file.h"
#include "openexr_zip.h"
#include "row_source.h"

namespace kiln::io {
namespace {

using Imath::Box2i;

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

// Rows from `first` up to `end` of the data window, block by block. Planes are made once the first
// block could be read, so a header that promises much and has nothing behind it costs little.
void read_rows(Imf::InputPart& part, const std::vector<std::string>& channels, int first,
               long long end, Layers& image) {
  const Box2i stored = part.header().dataWindow();
  const Box2i shown = part.header().displayWindow();
  Block block{first, 0, stored.max.x - stored.min.x + 1, {}};
  const int rows = rows_of_block(part.header());
  while (block.first < end) {
    block.rows = static_cast<int>(std::min<long long>(rows, end - block.first));
    block.texels.resize(channels.size() * static_cast<size_t>(block.rows) *
                        static_cast<size_t>(block.width));
    read_block(part, channels, block);
    if (image.layers.empty()) {
      image = make_layers({shown.max.x - shown.min.x + 1, shown.max.y - shown.min.y + 1}, channels);
    }
    place_block(block, stored, shown, image);
    if (end - block.first <= block.rows) break;
    block.first += block.rows;
  }
}

bool contains(const Box2i& outer, const Box2i& inner) {
  return outer.intersects(inner.min) && outer.intersects(inner.max);
}

// The same where all that is stored is shown: straight into the rows from `at` on of planes that
// are there.
void read_rows_in_place(Imf::InputPart& part, const std::vector<std::string>& channels, int first,
                        long long end, Layers& image, int at) {
  const Box2i stored = part.header().dataWindow();
  const int left = stored.min.x - part.header().displayWindow().min.x;
  const int width = stored.max.x - stored.min.x + 1, rows = static_cast<int>(end - first);
  Imf::FrameBuffer frame;
  for (size_t c = 0; c < channels.size(); ++c) {
    Plane& plane = image.layers[c].plane;
    float* from = plane.row(at) + left;
    frame.insert(
        channels[c],
        Imf::Slice::Make(Imf::FLOAT, from, {stored.min.x, first}, width, rows, sizeof(float),
                         sizeof(float) * static_cast<size_t>(plane.stride())));
  }
  part.setFrameBuffer(frame);
  part.readPixels(first, first + rows - 1);
}

// At least as many lines as are compressed together, so that none is unpacked twice.
int rows_of_band(const Imf::Header& header) {
  return header.compression() == Imf::DWAB_COMPRESSION ? 256 : 32;
}

// Bands of a large file of lines are unpacked side by side, each through a reader of its own.
Layers read_part(const std::filesystem::path& path, Imf::InputPart& part,
                 const std::vector<std::string>& channels, const RunTasks& run) {
  const int rows = rows_of_band(part.header());
  const Box2i stored = part.header().dataWindow();
  const long long end = static_cast<long long>(stored.max.y) + 1;
  const long long bands = (end - stored.min.y + rows - 1) / rows;
  Layers image;
  if (!run || bands < 2 || part.header().hasTileDescription()) {
    read_rows(part, channels, stored.min.y, end, image);
    return image;
  }
  read_rows(part, channels, stored.min.y, static_cast<long long>(stored.min.y) + rows, image);
  const bool in_place = contains(part.header().displayWindow(), stored);
  const bool packed_by_zip = has_zip_rows(part.header());
  run(static_cast<int>(bands - 1), [&](int band) {
    Imf::MultiPartInputFile file(path.c_str(), 0, false);
    Imf::InputPart own(file, 0);
    const long long first = stored.min.y + (band + 1LL) * rows;
    const auto top = static_cast<int>(first);
    const long long bottom = std::min(end, first + rows);
    if (!in_place) return read_rows(own, channels, top, bottom, image);
    const int at = top - part.header().displayWindow().min.y;
    const auto read = packed_by_zip ? read_zip_rows : read_rows_in_place;
    read(own, channels, top, bottom, image, at);
  });
  return image;
}

std::vector<std::string> wanted_channels(const FileFacts& facts, const Reading& reading) {
  std::vector<std::string> wanted;
  std::copy_if(facts.channels.begin(), facts.channels.end(), std::back_inserter(wanted),
               [&](const std::string& channel) { return reading.wants(channel); });
  return wanted;
}

class OpenExrRows : public RowSource {
 public:
  OpenExrRows(const std::filesystem::path& path, const Reading& reading)
      : file_(path.c_str(), 0, false),
        facts_(openexr_facts(file_, OpenexrUse::Image, reading.limits)) {
    if (!file_.partComplete(0)) throw Error(Fault::Input, "truncated OpenEXR file");
    part_ = std::make_unique<Imf::InputPart>(file_, 0);
    names_ = wanted_channels(facts_, reading);
    packed_by_zip_ = has_zip_rows(part_->header());
  }

  const FileFacts& facts() const override { return facts_; }
  const std::vector<std::string>& names() const override { return names_; }
  int block_rows() const override {
    const int block = rows_of_block(part_->header());
    return part_->header().compression() == Imf::DWAB_COMPRESSION ? std::max(block, 256) : block;
  }
  void read(int first, int rows, Layers& image, int at) override {
    reading_openexr([&] {
      const int top = part_->header().dataWindow().min.y + first;
      const auto read = packed_by_zip_ ? read_zip_rows : read_rows_in_place;
      read(*part_, names_, top, static_cast<long long>(top) + rows, image, at);
    });
  }

 private:
  Imf::MultiPartInputFile file_;
  FileFacts facts_;
  std::unique_ptr<Imf::InputPart> part_;
  std::vector<std::string> names_;
  bool packed_by_zip_ = false;
};

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
    return openexr_facts(file, OpenexrUse::Image, limits);
  });
}

ImageFile read_openexr(const std::filesystem::path& path, const Reading& reading) {
  return reading_openexr([&] {
    Imf::MultiPartInputFile file(path.c_str(), 0, false);
    ImageFile result;
    result.facts = openexr_facts(file, OpenexrUse::Image, reading.limits);
    if (!file.partComplete(0)) throw Error(Fault::Input, "truncated OpenEXR file");
    Imf::InputPart part(file, 0);
    result.image = read_part(path, part, wanted_channels(result.facts, reading), reading.run);
    if (covers_part(result.image)) {
      result.facts.notes.emplace_back("alpha is not 1 everywhere; colour is as stored beside it");
    }
    return result;
  });
}

std::unique_ptr<RowSource> openexr_rows(const std::filesystem::path& path, const Reading& reading) {
  return reading_openexr([&] { return std::make_unique<OpenExrRows>(path, reading); });
}

}  // namespace kiln::io

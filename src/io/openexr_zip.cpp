// SPDX-License-Identifier: Apache-2.0
#include "openexr_zip.h"

#include <Imath/half.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfCompression.h>
#include <OpenEXR/ImfHeader.h>
#include <fmt/format.h>
#include <libdeflate.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <memory>
#include <span>

#include "kiln/core/error.h"

namespace kiln::io {
namespace {

constexpr int lines_of_block = 16;

using Bytes = std::vector<std::uint8_t>;

/// Where the channels of a line begin. OpenEXR sorts them by name, each with all its samples.
struct Line {
  struct Channel {
    size_t begin;
    Imf::PixelType type;
    Plane* plane;
  };
  std::vector<Channel> channels;  ///< those that are wanted
  size_t bytes = 0;
};

Line line_of(const Imf::Header& header, const std::vector<std::string>& wanted, Layers& image) {
  const auto width = static_cast<size_t>(header.dataWindow().max.x - header.dataWindow().min.x + 1);
  Line line;
  const Imf::ChannelList& stored = header.channels();
  for (auto channel = stored.begin(); channel != stored.end(); ++channel) {
    const Imf::PixelType type = channel.channel().type;
    const auto found = std::find(wanted.begin(), wanted.end(), channel.name());
    if (found != wanted.end()) {
      Layer& layer = image.layers[static_cast<size_t>(found - wanted.begin())];
      line.channels.push_back({line.bytes, type, &layer.plane});
    }
    line.bytes += width * (type == Imf::HALF ? 2 : 4);
  }
  return line;
}

/// Unpacks blocks, in memory that is kept from one to the next.
class Unpacker {
 public:
  // Which stay packed by nothing where that would make them longer.
  const std::uint8_t* unpack(std::span<const std::uint8_t> block, size_t bytes) {
    if (block.size() == bytes) return block.data();
    split_.resize(bytes);
    raw_.resize(bytes);
    const auto result = libdeflate_zlib_decompress(decompressor_.get(), block.data(), block.size(),
                                                   split_.data(), bytes, nullptr);
    if (result != LIBDEFLATE_SUCCESS) {
      throw Error(Fault::Input, "damaged OpenEXR file: a block of lines cannot be unpacked");
    }
    add_up();
    interleave();
    return raw_.data();
  }

 private:
  struct Free {
    void operator()(libdeflate_decompressor* it) const { libdeflate_free_decompressor(it); }
  };

  // Each byte is stored as its difference from the one before, plus 128.
  void add_up() {
    for (size_t i = 1; i < split_.size(); ++i) {
      split_[i] = static_cast<std::uint8_t>(split_[i - 1] + split_[i] - 128);
    }
  }

  // The bytes at even places come first, those at odd ones behind them.
  void interleave() {
    const size_t pairs = raw_.size() / 2;
    const std::uint8_t* even = split_.data();
    const std::uint8_t* odd = split_.data() + (raw_.size() + 1) / 2;
    for (size_t i = 0; i < pairs; ++i) {
      raw_[2 * i] = even[i];
      raw_[2 * i + 1] = odd[i];
    }
    if (raw_.size() % 2 == 1) raw_.back() = even[pairs];
  }

  std::unique_ptr<libdeflate_decompressor, Free> decompressor_{libdeflate_alloc_decompressor()};
  Bytes split_, raw_;
};

template <class Stored>
void load(const std::uint8_t* from, std::span<float> row) {
  for (float& value : row) {
    Stored stored;
    std::memcpy(&stored, from, sizeof stored);
    value = stored;
    from += sizeof stored;
  }
}

}  // namespace

bool has_zip_rows(const Imf::Header& header) {
  if (header.compression() != Imf::ZIP_COMPRESSION || header.hasTileDescription()) return false;
  for (auto it = header.channels().begin(); it != header.channels().end(); ++it) {
    const Imf::Channel& channel = it.channel();
    if (channel.xSampling != 1 || channel.ySampling != 1 || channel.type == Imf::UINT) return false;
  }
  return true;
}

void read_zip_rows(Imf::InputPart& part, const std::vector<std::string>& channels, int first,
                   long long end, Layers& image, int at) {
  const Imf::Header& header = part.header();
  const auto left = static_cast<size_t>(header.dataWindow().min.x - header.displayWindow().min.x);
  const auto width = static_cast<size_t>(header.dataWindow().max.x - header.dataWindow().min.x + 1);
  const Line line = line_of(header, channels, image);
  Unpacker unpacker;
  for (int y = first; y < end; y += lines_of_block) {
    const int rows = static_cast<int>(std::min<long long>(lines_of_block, end - y));
    const char* packed = nullptr;
    int size = 0;
    part.rawPixelData(y, packed, size);
    const std::span block(reinterpret_cast<const std::uint8_t*>(packed), static_cast<size_t>(size));
    const std::uint8_t* raw = unpacker.unpack(block, line.bytes * static_cast<size_t>(rows));
    for (int i = 0; i < rows; ++i, raw += line.bytes) {
      for (const Line::Channel& channel : line.channels) {
        const std::span row(channel.plane->row(at + y - first + i) + left, width);
        if (channel.type == Imf::HALF) {
          load<half>(raw + channel.begin, row);
        } else {
          load<float>(raw + channel.begin, row);
        }
      }
    }
  }
}

}  // namespace kiln::io

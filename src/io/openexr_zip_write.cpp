// SPDX-License-Identifier: Apache-2.0
#include "openexr_zip_write.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfVersion.h>
#include <libdeflate.h>

#include <algorithm>
#include <cstring>
#include <new>
#include <numeric>

#include "openexr_header.h"
#include "openexr_stream.h"
#include "samples.h"

namespace kiln::io {
namespace {

constexpr int lines_of_block = 16;
constexpr size_t blocks_at_once = 16;  // that are packed side by side
// As long as zlib's level 4, which is the library's, in a third of its time.
constexpr int level = 4;

struct Compressor {
  struct Free {
    void operator()(libdeflate_compressor* it) const { libdeflate_free_compressor(it); }
  };
  std::unique_ptr<libdeflate_compressor, Free> held{libdeflate_alloc_compressor(level)};

  size_t pack(const Bytes& from, Bytes& to) const {
    if (!held) throw std::bad_alloc();
    return libdeflate_zlib_compress(held.get(), from.data(), from.size(), to.data(), to.size());
  }
};

// Bytes at even places first, those at odd ones behind them.
void split_pairs(const Bytes& raw, Bytes& split) {
  std::uint8_t* even = split.data();
  std::uint8_t* odd = split.data() + (raw.size() + 1) / 2;
  const size_t pairs = raw.size() / 2;
  for (size_t i = 0; i < pairs; ++i) {
    even[i] = raw[2 * i];
    odd[i] = raw[2 * i + 1];
  }
  if (raw.size() % 2 == 1) even[pairs] = raw.back();
}

// Each byte as its difference from the one before, plus 128.
void take_differences(Bytes& bytes) {
  for (size_t i = bytes.size() - 1; i > 0; --i) {
    bytes[i] = static_cast<std::uint8_t>(bytes[i] - bytes[i - 1] + 128);
  }
}

bool is_long(const char* name) { return std::strlen(name) > 31; }

// Names of more than 31 letters have to be announced.
bool has_long_names(const Imf::Header& header) {
  for (auto it = header.begin(); it != header.end(); ++it) {
    if (is_long(it.name()) || is_long(it.attribute().typeName())) return true;
  }
  for (auto it = header.channels().begin(); it != header.channels().end(); ++it) {
    if (is_long(it.name())) return true;
  }
  return false;
}

template <class Number>
void append_number(ByteStream& out, Number number) {
  out.append({reinterpret_cast<const char*>(&number), sizeof number});
}

// Channels lie in the order of their names.
std::vector<size_t> order_of(const std::vector<std::string>& names) {
  std::vector<size_t> order(names.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::sort(order.begin(), order.end(), [&](size_t a, size_t b) { return names[a] < names[b]; });
  return order;
}

bool is_color(const std::string& name) { return channel_rank(name) < channel_rank("A"); }

}  // namespace

std::span<const float> row_to_store(const StoredPlanes& band, size_t channel, int row,
                                    AlphaStorage alpha, std::span<float> scratch) {
  const auto texels = band.planes[channel]->texels_of_row(row);
  if (alpha != AlphaStorage::Premultiplied || band.alpha_channel < 0 ||
      !is_color(band.names[channel])) {
    return texels;
  }
  const auto share = band.planes[static_cast<size_t>(band.alpha_channel)]->texels_of_row(row);
  std::transform(texels.begin(), texels.end(), share.begin(), scratch.begin(),
                 [](float color, float a) { return color * a; });
  return scratch;
}

/// Lines that are packed together.
struct ZipEncoder::Block {
  Bytes raw, split, packed;
  size_t packed_bytes = 0;
  std::vector<float> row;  ///< of colours times alpha
  Compressor compressor;
  WriteFacts facts;

  void pack() {
    split.resize(raw.size());
    split_pairs(raw, split);
    take_differences(split);
    packed.resize(raw.size());
    packed_bytes = compressor.pack(split, packed);
  }

  // Not packed where that would not make them shorter.
  std::string_view stored() const {
    const bool shorter = packed_bytes > 0 && packed_bytes < raw.size();
    const Bytes& bytes = shorter ? packed : raw;
    return {reinterpret_cast<const char*>(bytes.data()), shorter ? packed_bytes : raw.size()};
  }
};

/// Lines of a band that lie in one block.
struct ZipEncoder::Piece {
  int first = 0, rows = 0;  ///< of the band
  int line = 0;             ///< of the block
  bool ends_block = false;
};

ZipEncoder::ZipEncoder(const FileToWrite& file, const StoredPlanes& layout,
                       const Imf::Header& header)
    : file_(file),
      order_(order_of(layout.names)),
      row_bytes_(static_cast<size_t>(file.size.width) * sample_bytes(file.options.type)),
      blocks_(blocks_at_once) {
  const int flags = has_long_names(header) ? Imf::LONG_NAMES_FLAG : 0;
  append_number(file_.out, std::int32_t{Imf::MAGIC});
  append_number(file_.out, std::int32_t{Imf::EXR_VERSION | flags});
  writing_openexr([&] {
    header.sanityCheck();
    ExrStream stream(file_.path.string(), file_.out);
    header.writeTo(stream);
  });
  places_at_ = file_.out.position();
  const int blocks = (file_.size.height + lines_of_block - 1) / lines_of_block;
  for (int i = 0; i < blocks; ++i) append_number(file_.out, std::uint64_t{0});
}

ZipEncoder::~ZipEncoder() = default;

std::vector<ZipEncoder::Piece> ZipEncoder::next_pieces(int first, int rows) const {
  std::vector<Piece> pieces;
  pieces.reserve(blocks_at_once);
  int line = next_row_ % lines_of_block, row = next_row_;
  while (rows > 0 && pieces.size() < blocks_at_once) {
    const int count = std::min(lines_of_block - line, rows);
    row += count;
    pieces.push_back({first, count, line, row % lines_of_block == 0 || row == file_.size.height});
    first += count;
    rows -= count;
    line = 0;
  }
  return pieces;
}

void ZipEncoder::add(const StoredPlanes& band) {
  const int height = band.size().height;
  for (int first = 0; first < height;) {
    const std::vector<Piece> pieces = next_pieces(first, height - first);
    const auto task = [&](int i) {
      const auto at = static_cast<size_t>(i);
      fill(pieces[at], band, blocks_[at]);
      if (pieces[at].ends_block) blocks_[at].pack();
    };
    const int count = static_cast<int>(pieces.size());
    if (file_.options.run) {
      file_.options.run(count, task);
    } else {
      for (int i = 0; i < count; ++i) task(i);
    }
    for (size_t i = 0; i < pieces.size(); ++i) write(pieces[i], blocks_[i]);
    first = pieces.back().first + pieces.back().rows;
    // What is not complete is the first of the next.
    if (!pieces.back().ends_block) std::swap(blocks_.front(), blocks_[pieces.size() - 1]);
  }
}

void ZipEncoder::fill(const Piece& piece, const StoredPlanes& band, Block& block) const {
  const size_t line_bytes = row_bytes_ * band.planes.size();
  block.raw.resize(line_bytes * static_cast<size_t>(piece.line + piece.rows));
  block.row.resize(static_cast<size_t>(file_.size.width));
  auto* to =
      reinterpret_cast<std::byte*>(block.raw.data()) + line_bytes * static_cast<size_t>(piece.line);
  for (int i = 0; i < piece.rows; ++i) {
    for (const size_t channel : order_) {
      const auto row = row_to_store(band, channel, piece.first + i, file_.options.alpha, block.row);
      store_samples(row, file_.options.type, 1, to, block.facts);
      to += row_bytes_;
    }
  }
}

void ZipEncoder::write(const Piece& piece, Block& block) {
  file_.facts.clamped += block.facts.clamped;
  file_.facts.not_a_number += block.facts.not_a_number;
  file_.facts.largest_clamped = std::max(file_.facts.largest_clamped, block.facts.largest_clamped);
  block.facts = {};
  const int first_line = next_row_ - piece.line;
  next_row_ += piece.rows;
  if (!piece.ends_block) return;
  const std::string_view bytes = block.stored();
  places_.push_back(file_.out.position());
  append_number(file_.out, static_cast<std::int32_t>(first_line));
  append_number(file_.out, static_cast<std::int32_t>(bytes.size()));
  file_.out.append(bytes);
}

void ZipEncoder::finish() {
  const std::uint64_t end = file_.out.position();
  file_.out.seek(places_at_);
  for (const std::uint64_t place : places_) append_number(file_.out, place);
  file_.out.seek(end);
}

}  // namespace kiln::io

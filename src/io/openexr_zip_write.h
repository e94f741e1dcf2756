// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <OpenEXR/ImfHeader.h>

#include <cstdint>
#include <span>
#include <vector>

#include "band_encoder.h"

namespace kiln::io {

using Bytes = std::vector<std::uint8_t>;

/// A row of a channel as a file with such alpha stores it.
/// @param scratch  a row, where the colours are changed
std::span<const float> row_to_store(const StoredPlanes& band, size_t channel, int row,
                                    AlphaStorage alpha, std::span<float> scratch);

/// Scan lines packed by ZIP, blocks of 16 side by side: what Imf::OutputFile writes but for the
/// packed bytes, which libdeflate makes several times faster than zlib.
///
/// | what      | bytes                                                       |
/// |-----------|-------------------------------------------------------------|
/// | magic     | 4, and 4 of version and flags                               |
/// | header    | attributes, as the library writes them                      |
/// | places    | 8 for each block: where it begins in the file               |
/// | blocks    | first line (4), bytes that follow (4), the lines, packed    |
///
/// Numbers have their lowest byte first, as has every processor that this runs on.
/// @source  "OpenEXR File Layout", openexr.com
class ZipEncoder : public BandEncoder {
 public:
  /// @param header  of one part, half or float, ZIP, none subsampled
  ZipEncoder(const FileToWrite& file, const StoredPlanes& layout, const Imf::Header& header);
  ~ZipEncoder() override;

  void add(const StoredPlanes& band) override;
  void finish() override;

 private:
  struct Block;
  struct Piece;

  std::vector<Piece> next_pieces(int first, int rows) const;
  void fill(const Piece& piece, const StoredPlanes& band, Block& block) const;
  void write(const Piece& piece, Block& block);

  FileToWrite file_;
  std::vector<size_t> order_;  ///< of channels in a line
  size_t row_bytes_;           ///< of one channel
  std::vector<Block> blocks_;  ///< the first may hold lines already
  std::uint64_t places_at_ = 0;
  std::vector<std::uint64_t> places_;
  int next_row_ = 0;
};

}  // namespace kiln::io

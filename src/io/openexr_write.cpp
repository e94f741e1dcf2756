// SPDX-License-Identifier: Apache-2.0
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfOutputFile.h>

#include <algorithm>
#include <cstdint>
#include <exception>
#include <optional>
#include <span>
#include <vector>

#include "kiln/core/error.h"
#include "openexr_file.h"
#include "openexr_header.h"
#include "openexr_stream.h"
#include "openexr_zip_write.h"
#include "samples.h"

namespace kiln::io {
namespace {

Imf::Header header_of(Size size, const StoredPlanes& layout, const WriteOptions& options) {
  Imf::Header header(size.width, size.height);
  header.compression() =
      options.packing == Packing::Fast ? Imf::NO_COMPRESSION : Imf::ZIP_COMPRESSION;
  add_channels(layout.names, options.type, header);
  add_attributes(options.attributes, header);
  return header;
}

// Writes rows that are not packed.
class UnpackedEncoder : public BandEncoder {
 public:
  UnpackedEncoder(const FileToWrite& file, const StoredPlanes& layout, const Imf::Header& header)
      : file_(file),
        row_bytes_(static_cast<size_t>(file.size.width) * sample_bytes(file.options.type)),
        stored_(layout.planes.size() * rows * row_bytes_),
        scratch_(static_cast<size_t>(file.size.width)),
        stream_(file.path.string(), file.out) {
    writing_openexr([&] { output_.emplace(stream_, header, 0); });
  }

  void add(const StoredPlanes& band) override {
    const int height = band.size().height;
    for (int first = 0; first < height; first += rows) {
      const int count = std::min(rows, height - first);
      for (size_t c = 0; c < band.planes.size(); ++c) fill(band, c, first, count);
      writing_openexr([&] {
        output_->setFrameBuffer(frame_of(band.names));
        output_->writePixels(count);
      });
      written_ += count;
    }
  }

  // The library writes its table of offsets as the output ends.
  void finish() override { output_.reset(); }

 private:
  static constexpr int rows = 16;

  std::byte* stored_row(size_t channel, int row_of_block) {
    return stored_.data() + (channel * rows + static_cast<size_t>(row_of_block)) * row_bytes_;
  }

  void fill(const StoredPlanes& band, size_t channel, int first, int count) {
    for (int i = 0; i < count; ++i) {
      const auto row = row_to_store(band, channel, first + i, file_.options.alpha, scratch_);
      store_samples(row, file_.options.type, 1, stored_row(channel, i), file_.facts);
    }
  }

  Imf::FrameBuffer frame_of(const std::vector<std::string>& names) {
    Imf::FrameBuffer frame;
    const Imf::PixelType type = library_type(file_.options.type);
    for (size_t c = 0; c < names.size(); ++c) {
      frame.insert(names[c], Imf::Slice::Make(type, stored_row(c, 0), Imath::V2i(0, written_),
                                              file_.size.width, rows));
    }
    return frame;
  }

  FileToWrite file_;
  size_t row_bytes_;
  std::vector<std::byte> stored_;
  std::vector<float> scratch_;
  ExrStream stream_;
  std::optional<Imf::OutputFile> output_;
  int written_ = 0;
};

}  // namespace

std::unique_ptr<BandEncoder> openexr_encoder(const FileToWrite& file, const StoredPlanes& layout) {
  const Imf::Header header = header_of(file.size, layout, file.options);
  if (file.options.packing == Packing::Zip) {
    return std::make_unique<ZipEncoder>(file, layout, header);
  }
  return std::make_unique<UnpackedEncoder>(file, layout, header);
}

}  // namespace kiln::io

// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <vector>

#include "kiln/core/error.h"
#include "openimageio_file.h"
#include "openimageio_loader.h"
#include "samples.h"
#include "tiff_description.h"

namespace kiln::io {
namespace {

constexpr int block_rows = 64;

Attributes attributes_for(const FileToWrite& file) {
  if (file.format == "jpeg") return {};
  Attributes attributes = file.options.attributes;
  if (file.options.color_tag == ColorTag::Srgb) {
    attributes.emplace_back("oiio:ColorSpace", "sRGB");
  } else if (file.options.color_tag == ColorTag::Linear) {
    attributes.emplace_back("oiio:ColorSpace", "Linear");
  }
  return file.format == "tiff" ? as_tiff_tags(attributes) : attributes;
}

// Where a file begins in a stream.
struct Beginning {
  ByteStream& out;
  uint64_t place = 0;
};

void write_to(void* beginning, uint64_t place, const void* bytes, size_t count) {
  const auto& [out, first] = *static_cast<const Beginning*>(beginning);
  out.seek(first + place);
  out.append({static_cast<const char*>(bytes), count});
}

class OpenImageIoEncoder : public BandEncoder {
 public:
  OpenImageIoEncoder(const FileToWrite& file, const StoredPlanes& layout)
      : file_(file),
        format_(file.format),
        row_bytes_(static_cast<size_t>(file.size.width) * layout.planes.size() *
                   sample_bytes(file.options.type)),
        samples_(row_bytes_ * block_rows),
        beginning_{file.out, file.out.position()},
        writer_(create(layout), openimageio().drop) {
    if (!writer_) fail();
  }

  void add(const StoredPlanes& band) override {
    const int height = band.size().height;
    for (int first = 0; first < height; first += block_rows) {
      const int rows = std::min(block_rows, height - first);
      for (int i = 0; i < rows; ++i) {
        fill_row(band, first + i, samples_.data() + static_cast<size_t>(i) * row_bytes_);
      }
      if (!openimageio().write_rows(writer_.get(), written_, rows, samples_.data())) fail();
      written_ += rows;
    }
  }

  void finish() override {
    if (!openimageio().finish(writer_.get())) fail();
  }

 private:
  module::Writer* create(const StoredPlanes& layout) {
    const Attributes attributes = attributes_for(file_);
    std::vector<module::Attribute> texts;
    for (const auto& [name, text] : attributes) texts.push_back({name.c_str(), text.c_str()});
    module::WrittenImage image;
    image.format = format_.c_str();
    image.width = file_.size.width;
    image.height = file_.size.height;
    image.channels = static_cast<int>(layout.planes.size());
    image.type = file_.options.type;
    image.alpha_channel = layout.alpha_channel;
    image.fast = file_.options.packing == Packing::Fast ? 1 : 0;
    image.texts = texts.data();
    image.text_count = static_cast<int>(texts.size());
    const module::Sink sink{&beginning_, write_to};
    return openimageio().create(&image, &sink);
  }

  // Absent channels keep their zeros.
  void fill_row(const StoredPlanes& band, int y, std::byte* samples) {
    const PixelType type = file_.options.type;
    for (size_t c = 0; c < band.planes.size(); ++c) {
      if (band.planes[c] == nullptr) continue;
      store_samples(band.planes[c]->texels_of_row(y), type, band.planes.size(),
                    samples + c * sample_bytes(type), file_.facts);
    }
  }

  [[noreturn]] void fail() const {
    throw Error(Fault::Output,
                fmt::format("cannot encode as {}: {}", format_, openimageio_error()));
  }

  FileToWrite file_;
  std::string format_;
  size_t row_bytes_;
  std::vector<std::byte> samples_;
  Beginning beginning_;
  std::unique_ptr<module::Writer, void (*)(module::Writer*)> writer_;
  int written_ = 0;
};

}  // namespace

std::unique_ptr<BandEncoder> openimageio_encoder(const FileToWrite& file,
                                                 const StoredPlanes& layout) {
  return std::make_unique<OpenImageIoEncoder>(file, layout);
}

}  // namespace kiln::io

// SPDX-License-Identifier: Apache-2.0
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <exception>
#include <span>
#include <utility>
#include <vector>

#include "kiln/core/error.h"
#include "openexr_file.h"
#include "samples.h"

namespace kiln::io {
namespace {

namespace fs = std::filesystem;

// The library writes its table of offsets in a destructor and so cannot report a full disk. This
// stream remembers the first failure until it is asked.
class RememberingStream : public Imf::OStream {
 public:
  RememberingStream(const fs::path& temporary, const fs::path& shown_path)
      : Imf::OStream(shown_path.c_str()), file_(std::fopen(temporary.c_str(), "wb")) {
    if (file_ == nullptr) reason_ = errno;
  }
  ~RememberingStream() override {
    if (file_ != nullptr) std::fclose(file_);
  }
  RememberingStream(const RememberingStream&) = delete;
  RememberingStream& operator=(const RememberingStream&) = delete;

  void write(const char bytes[], int count) override {
    const auto wanted = static_cast<size_t>(count);
    if (reason_ == 0 && std::fwrite(bytes, 1, wanted, file_) != wanted) reason_ = errno;
    position_ += wanted;
  }
  uint64_t tellp() override { return position_; }
  void seekp(uint64_t position) override {
    if (reason_ == 0 && fseeko(file_, static_cast<off_t>(position), SEEK_SET) != 0) reason_ = errno;
    position_ = position;
  }

  /// Closes the file. @return 0, or the errno of the first failure
  int finish() {
    if (file_ == nullptr) return reason_;
    if (std::fclose(std::exchange(file_, nullptr)) != 0 && reason_ == 0) reason_ = errno;
    return reason_;
  }

 private:
  std::FILE* file_;
  int reason_ = 0;
  uint64_t position_ = 0;
};

Imf::Header header_of(const Layers& image, const WriteOptions& options) {
  Imf::Header header(image.size.width, image.size.height);
  header.compression() =
      options.packing == Packing::Fast ? Imf::NO_COMPRESSION : Imf::ZIP_COMPRESSION;
  const Imf::PixelType type = options.type == PixelType::Half ? Imf::HALF : Imf::FLOAT;
  for (const Layer& layer : image.layers) {
    if (header.channels().findChannel(layer.name) != nullptr || layer.name.empty()) {
      throw Error(Fault::Usage,
                  fmt::format("channel name '{}' is empty or used twice", layer.name));
    }
    header.channels().insert(layer.name, Imf::Channel(type));
  }
  for (const auto& [name, text] : options.attributes) {
    if (name.empty() || header.find(name) != header.end()) {
      throw Error(Fault::Usage,
                  fmt::format("metadata name '{}' is empty, used twice or the format's own", name));
    }
    header.insert(name, Imf::StringAttribute(text));
  }
  return header;
}

bool is_color(const std::string& name) { return channel_rank(name) < channel_rank("A"); }

// Writes rows in blocks of what ZIP compresses at once, and no rounding depends on their number.
class BlockWriter {
 public:
  BlockWriter(const Layers& image, const WriteOptions& options)
      : image_(image),
        options_(options),
        alpha_(options.alpha == AlphaStorage::Premultiplied ? image.find("A") : nullptr),
        row_bytes_(static_cast<size_t>(image.size.width) * sample_bytes(options.type)),
        stored_(image.layers.size() * rows * row_bytes_),
        scratch_(static_cast<size_t>(image.size.width)) {}

  void write_to(Imf::OutputFile& file) {
    for (int first = 0; first < image_.size.height; first += rows) {
      const int count = std::min(rows, image_.size.height - first);
      for (size_t c = 0; c < image_.layers.size(); ++c) fill(c, first, count);
      file.setFrameBuffer(frame_at(first));
      file.writePixels(count);
    }
  }
  const WriteFacts& facts() const { return facts_; }

 private:
  static constexpr int rows = 16;

  std::byte* stored_row(size_t channel, int row_of_block) {
    return stored_.data() + (channel * rows + static_cast<size_t>(row_of_block)) * row_bytes_;
  }

  void fill(size_t channel, int first, int count) {
    const Layer& layer = image_.layers[channel];
    for (int i = 0; i < count; ++i) {
      std::span<const float> row = layer.plane.texels_of_row(first + i);
      if (alpha_ != nullptr && is_color(layer.name)) {
        std::transform(row.begin(), row.end(), alpha_->row(first + i), scratch_.begin(),
                       [](float color, float a) { return color * a; });
        row = scratch_;
      }
      store_samples(row, options_.type, 1, stored_row(channel, i), facts_);
    }
  }

  Imf::FrameBuffer frame_at(int first) {
    Imf::FrameBuffer frame;
    const Imf::PixelType type = options_.type == PixelType::Half ? Imf::HALF : Imf::FLOAT;
    for (size_t c = 0; c < image_.layers.size(); ++c) {
      frame.insert(
          image_.layers[c].name,
          Imf::Slice::Make(type, stored_row(c, 0), Imath::V2i(0, first), image_.size.width, rows));
    }
    return frame;
  }

  const Layers& image_;
  const WriteOptions& options_;
  const Plane* alpha_;
  size_t row_bytes_;
  std::vector<std::byte> stored_;
  std::vector<float> scratch_;
  WriteFacts facts_;
};

}  // namespace

WriteFacts write_openexr(const fs::path& temporary, const fs::path& shown_path, const Layers& image,
                         const WriteOptions& options) {
  const Imf::Header header = header_of(image, options);
  RememberingStream stream(temporary, shown_path);
  BlockWriter writer(image, options);
  try {
    Imf::OutputFile file(stream, header, 0);
    writer.write_to(file);
  } catch (const std::exception& error) {
    throw Error(Fault::Output,
                fmt::format("{}: cannot write: {}", shown_path.string(), error.what()));
  }
  if (const int reason = stream.finish(); reason != 0) {
    throw Error(Fault::Output,
                fmt::format("{}: cannot write: {}", shown_path.string(), std::strerror(reason)));
  }
  return writer.facts();
}

}  // namespace kiln::io

// SPDX-License-Identifier: Apache-2.0
#include "kiln/io/image_rows.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "file_bytes.h"
#include "kiln/core/error.h"
#include "row_source.h"
#include "signature.h"

namespace kiln {
namespace {

namespace fs = std::filesystem;

void copy_rows(const Layers& from, int first, int rows, Layers& to, int at) {
  for (size_t c = 0; c < to.layers.size(); ++c) {
    for (int y = 0; y < rows; ++y) {
      const auto row = from.layers[c].plane.texels_of_row(first + y);
      std::copy(row.begin(), row.end(), to.layers[c].plane.row(at + y));
    }
  }
}

/// A file that is held, since its rows cannot be read from the top.
class HeldRows : public io::RowSource {
 public:
  explicit HeldRows(ImageFile file) : file_(std::move(file)) {
    for (const Layer& layer : file_.image.layers) names_.push_back(layer.name);
  }

  const FileFacts& facts() const override { return file_.facts; }
  const std::vector<std::string>& names() const override { return names_; }
  int block_rows() const override { return 1; }
  void read(int first, int rows, Layers& image, int at) override {
    copy_rows(file_.image, first, rows, image, at);
  }

 private:
  ImageFile file_;
  std::vector<std::string> names_;
};

bool is_held(std::string_view format) {
  constexpr std::array formats{"hdr", "npy", "env", "dds", "ktx", "ktx2"};
  return std::count(formats.begin(), formats.end(), format) > 0;
}

std::unique_ptr<io::RowSource> open_rows(const fs::path& path,
                                         const std::vector<std::string>& channels,
                                         const ReadLimits& limits) {
  const io::Reading reading{.limits = limits, .channels = channels};
  const std::string format =
      io::format_by_contents(path, io::first_bytes(path, io::signature_length));
  std::unique_ptr<io::RowSource> rows;
  with_context(path.string(), [&] {
    if (format == "openexr") rows = io::openexr_rows(path, reading);
    if (!is_held(format) && format != "openexr") rows = io::openimageio_rows(path, format, reading);
  });
  if (rows && !is_held_whole(rows->facts())) return rows;
  return std::make_unique<HeldRows>(read_image(path, limits, channels));
}

}  // namespace

bool is_held_whole(const FileFacts& facts) {
  return is_held(facts.format) || !facts.stored_as_shown;
}

long long bytes_kept(const fs::path& path, const FileFacts& facts) {
  if (facts.format == "openexr") return 0;
  std::error_code failure;
  const uintmax_t size = fs::file_size(path, failure);
  if (failure) return 0;
  const bool is_mapped = size > io::FileContents::largest_held;
  return static_cast<long long>(is_mapped ? io::FileContents::mapped_piece : size);
}

ImageRows::ImageRows(const fs::path& path, const std::vector<std::string>& channels,
                     const ReadLimits& limits)
    : path_(path), source_(open_rows(path, channels, limits)) {}
ImageRows::ImageRows(const ImageBytes& bytes, const std::vector<std::string>& channels,
                     const ReadLimits& limits)
    : path_(bytes.name), source_(std::make_unique<HeldRows>(read_image(bytes, limits, channels))) {}
ImageRows::~ImageRows() = default;
ImageRows::ImageRows(ImageRows&&) noexcept = default;
ImageRows& ImageRows::operator=(ImageRows&&) noexcept = default;

const FileFacts& ImageRows::facts() const { return source_->facts(); }

Layers ImageRows::next(int rows) {
  return with_context(path_.string(), [&] {
    const Size size = facts().size;
    Layers result = make_layers({size.width, rows}, source_->names());
    int filled = 0;
    while (filled < rows) {
      const int held = pending_.size.height - pending_row_;
      if (held > 0) {
        const int taken = std::min(held, rows - filled);
        copy_rows(pending_, pending_row_, taken, result, filled);
        pending_row_ += taken;
        filled += taken;
        continue;
      }
      const int block = source_->block_rows(), left = size.height - read_;
      const int straight = std::min((rows - filled) / block * block, left);
      if (straight > 0 || rows - filled >= left) {
        const int taken = straight > 0 ? straight : left;
        source_->read(read_, taken, result, filled);
        read_ += taken;
        filled += taken;
        continue;
      }
      pending_ = make_layers({size.width, std::min(block, left)}, source_->names());
      pending_row_ = 0;
      source_->read(read_, pending_.size.height, pending_, 0);
      read_ += pending_.size.height;
    }
    return result;
  });
}

}  // namespace kiln

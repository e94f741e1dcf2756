// SPDX-License-Identifier: Apache-2.0
#include "openimageio_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <memory>
#include <new>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include "container_checks.h"
#include "kiln/core/error.h"
#include "openimageio_loader.h"
#include "orientation.h"
#include "row_source.h"
#include "samples.h"
#include "tiff_description.h"

namespace kiln::io {
namespace {

[[noreturn]] void refuse(const std::string& reason) { throw Error(Fault::Input, reason); }

struct Opened {
  std::unique_ptr<module::Reader, void (*)(module::Reader*)> reader;
  module::StoredImage stored;
};

// What the bytes themselves show, before a decoder sees them.
void check_container(const std::string& format, ByteView bytes, const ReadLimits& limits) {
  if (format == "dds" && !dds_may_hold_its_pixels(bytes)) {
    refuse("truncated: the header claims more texels than the file can hold");
  }
  if (format != "png") return;
  const auto header = png_header(bytes);
  if (!header) refuse("damaged PNG header");
  require_within(limits, header->size.width, header->size.height, 1);
  if (!png_may_hold_its_pixels(*header, bytes.size())) {
    refuse(fmt::format("truncated: the header claims {} x {} texels, which {} bytes cannot hold",
                       header->size.width, header->size.height, bytes.size()));
  }
}

Opened open(const std::string& format, ByteView bytes, const ReadLimits& limits) {
  check_container(format, bytes, limits);
  const module::Face& face = openimageio();
  Opened opened{{nullptr, face.close}, {}};
  opened.reader.reset(face.open(format.c_str(), bytes.data(), bytes.size(), &opened.stored));
  if (!opened.reader) refuse(fmt::format("damaged {} file: {}", format, openimageio_error()));
  require_within(limits, opened.stored.width, opened.stored.height, opened.stored.channels);
  return opened;
}

std::optional<std::string> color_tag(const std::string& format, ByteView bytes,
                                     const Attributes& attributes) {
  if (format == "png") return png_color_tag(bytes);
  for (const auto& [name, text] : attributes) {
    if (name == "ICCProfile:profile_description") return "icc: " + text;
  }
  return std::nullopt;
}

// The library's own notes about a file are no metadata of it.
bool is_of_the_file(std::string_view name) {
  return !name.starts_with("oiio:") && !name.starts_with("png:") && !name.starts_with("jpeg:") &&
         !name.starts_with("tiff:") && !name.starts_with("ICCProfile");
}

FileFacts facts_of(const std::string& format, ByteView bytes, const Opened& opened) {
  const module::Face& face = openimageio();
  const module::StoredImage& stored = opened.stored;
  FileFacts facts;
  facts.format = format;
  facts.size = oriented(Size{stored.width, stored.height}, stored.orientation);
  facts.stored_as_shown = stored.orientation == 1;
  facts.type = stored.type;
  for (int c = 0; c < stored.channels; ++c) {
    facts.channels.emplace_back(face.channel_name(opened.reader.get(), c));
  }
  Attributes all;
  for (int n = 0;; ++n) {
    const module::Attribute text = face.text(opened.reader.get(), n);
    if (text.name == nullptr) break;
    all.emplace_back(text.name, text.text);
  }
  facts.color_space_tag = color_tag(format, bytes, all);
  std::copy_if(all.begin(), all.end(), std::back_inserter(facts.attributes),
               [](const auto& attribute) { return is_of_the_file(attribute.first); });
  if (format == "tiff") facts.attributes = from_tiff_tags(facts.attributes);
  note_orientation(stored.orientation, facts);
  return facts;
}

/// The channels of a file that become planes, in its order.
struct Picked {
  std::vector<size_t> channels;
  std::vector<std::string> names;
};

Picked pick(const std::vector<std::string>& names, const Reading& reading) {
  Picked picked;
  for (size_t c = 0; c < names.size(); ++c) {
    if (!reading.wants(names[c])) continue;
    picked.channels.push_back(c);
    picked.names.push_back(names[c]);
  }
  return picked;
}

// Colour that was stored times alpha; 0 stays where nothing is left to divide.
void divide_by_alpha(std::span<const float> alpha, int y, Layers& image) {
  for (Layer& layer : image.layers) {
    if (channel_rank(layer.name) >= channel_rank("A")) continue;
    float* row = layer.plane.row(y);
    for (size_t x = 0; x < alpha.size(); ++x) {
      if (alpha[x] > 0.0f) row[x] /= alpha[x];
    }
  }
}

// A row of samples -> the row of each plane. TIFF says whether colour was multiplied by alpha.
void place_row(const std::byte* samples, const module::StoredImage& stored, const Picked& picked,
               int y, Layers& image) {
  const auto channels = static_cast<size_t>(stored.channels);
  const auto width = static_cast<size_t>(stored.width);
  const auto load = [&](size_t channel, std::span<float> row) {
    load_samples(samples + channel * sample_bytes(stored.type), stored.type, channels, row);
  };
  for (size_t i = 0; i < picked.channels.size(); ++i) {
    load(picked.channels[i], {image.layers[i].plane.row(y), width});
  }
  if (stored.premultiplied == 0) return;
  std::vector<float> alpha(width);
  load(static_cast<size_t>(stored.alpha_channel), alpha);
  divide_by_alpha(alpha, y, image);
}

int rows_of_block(const module::StoredImage& stored) {
  constexpr int least = 64;
  return (least + stored.block_rows - 1) / stored.block_rows * stored.block_rows;
}

// Samples of rows, in memory that is kept from one block to the next.
class RowReader {
 public:
  RowReader(const Opened& opened, Picked picked, std::string format)
      : opened_(opened),
        picked_(std::move(picked)),
        format_(std::move(format)),
        row_bytes_(static_cast<size_t>(opened.stored.width) *
                   static_cast<size_t>(opened.stored.channels) * sample_bytes(opened.stored.type)) {
  }

  const std::vector<std::string>& names() const { return picked_.names; }

  // Block by block, so that samples do not take more memory than texels.
  void read(int first, int rows, Layers& image, int at) {
    const int block = rows_of_block(opened_.stored);
    for (int done = 0; done < rows; done += block) {
      const int count = std::min(block, rows - done);
      read_block(first + done, count);
      if (image.layers.empty()) {
        image = make_layers({opened_.stored.width, opened_.stored.height}, picked_.names);
      }
      for (int i = 0; i < count; ++i) {
        place_row(samples_.data() + static_cast<size_t>(i) * row_bytes_, opened_.stored, picked_,
                  at + done + i, image);
      }
    }
  }

 private:
  void read_block(int first, int rows) {
    samples_.resize(row_bytes_ * static_cast<size_t>(rows));
    if (openimageio().read_rows(opened_.reader.get(), first, rows, samples_.data())) return;
    refuse(fmt::format("damaged {} file: {}", format_, openimageio_error()));
  }

  const Opened& opened_;
  Picked picked_;
  std::string format_;
  size_t row_bytes_;
  std::vector<std::byte> samples_;
};

// Planes are made once the first block could be read, so a header that promises much and has
// nothing behind it costs little.
Layers read_pixels(const Opened& opened, const Picked& picked, const std::string& format,
                   const Reading& reading) {
  RowReader rows(opened, picked, format);
  const int block = rows_of_block(opened.stored);
  Layers image;
  for (int first = 0; first < opened.stored.height; first += block) {
    rows.read(first, std::min(block, opened.stored.height - first), image, first);
    reading.let_go();
  }
  return image;
}

// What the bytes show of a file that ends too early.
void require_complete(const std::string& format, ByteView bytes, const LetGo& let_go) {
  if (format == "jpeg" && !jpeg_is_complete(bytes, let_go)) {
    refuse("truncated JPEG file: it has no end of image");
  }
  if (format == "png" && !png_is_complete(bytes, let_go)) {
    refuse("truncated PNG file: its chunks do not run to IEND");
  }
}

/// Facts, and what is to be known before rows are read.
struct Prepared {
  Opened opened;
  FileFacts facts;
};

Prepared prepare(const std::string& format, ByteView bytes, const Reading& reading) {
  Prepared prepared{open(format, bytes, reading.limits), {}};
  prepared.facts = facts_of(format, bytes, prepared.opened);
  require_complete(format, bytes, reading.let_go);
  module::StoredImage& stored = prepared.opened.stored;
  if (format != "tiff") stored.premultiplied = 0;
  if (stored.premultiplied != 0) {
    prepared.facts.notes.emplace_back("colour was stored multiplied by alpha; it was divided");
  }
  return prepared;
}

class OpenImageIoRows : public RowSource {
 public:
  OpenImageIoRows(const std::filesystem::path& path, const std::string& format,
                  const Reading& reading)
      : contents_(path),
        prepared_(prepare(format, contents_.view(), in_pieces(reading, contents_))),
        rows_(prepared_.opened, pick(prepared_.facts.channels, reading), format) {}

  const FileFacts& facts() const override { return prepared_.facts; }
  const std::vector<std::string>& names() const override { return rows_.names(); }
  int block_rows() const override { return rows_of_block(prepared_.opened.stored); }
  void read(int first, int rows, Layers& image, int at) override {
    rows_.read(first, rows, image, at);
    contents_.let_go();
  }

 private:
  FileContents contents_;
  Prepared prepared_;
  RowReader rows_;
};

}  // namespace

FileFacts inspect_by_openimageio(const std::string& format, ByteView bytes,
                                 const ReadLimits& limits) {
  return facts_of(format, bytes, open(format, bytes, limits));
}

ImageFile read_by_openimageio(const std::string& format, ByteView bytes, const Reading& reading) {
  Prepared prepared = prepare(format, bytes, reading);
  ImageFile file;
  file.facts = std::move(prepared.facts);
  try {
    file.image = read_pixels(prepared.opened, pick(file.facts.channels, reading), format, reading);
  } catch (const std::bad_alloc&) {
    refuse("too large for memory");
  }
  file.image = oriented(std::move(file.image), prepared.opened.stored.orientation);
  return file;
}

std::unique_ptr<RowSource> openimageio_rows(const std::filesystem::path& path,
                                            const std::string& format, const Reading& reading) {
  return std::make_unique<OpenImageIoRows>(path, format, reading);
}

}  // namespace kiln::io

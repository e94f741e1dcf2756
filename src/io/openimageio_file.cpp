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

// Planes are made once the first block could be read, so a header that promises much and has
// nothing behind it costs little.
Layers read_pixels(const Opened& opened, const Picked& picked, const std::string& format,
                   const Reading& reading) {
  const module::StoredImage& stored = opened.stored;
  const int block = rows_of_block(stored);
  const size_t row_bytes = static_cast<size_t>(stored.width) *
                           static_cast<size_t>(stored.channels) * sample_bytes(stored.type);
  std::vector<std::byte> samples(row_bytes * static_cast<size_t>(std::min(block, stored.height)));
  Layers image;
  for (int first = 0; first < stored.height; first += block) {
    const int rows = std::min(block, stored.height - first);
    if (!openimageio().read_rows(opened.reader.get(), first, rows, samples.data())) {
      refuse(fmt::format("damaged {} file: {}", format, openimageio_error()));
    }
    if (image.layers.empty()) image = make_layers({stored.width, stored.height}, picked.names);
    for (int i = 0; i < rows; ++i) {
      place_row(samples.data() + static_cast<size_t>(i) * row_bytes, stored, picked, first + i,
                image);
    }
    reading.let_go();
  }
  return image;
}

}  // namespace

FileFacts inspect_by_openimageio(const std::string& format, ByteView bytes,
                                 const ReadLimits& limits) {
  return facts_of(format, bytes, open(format, bytes, limits));
}

ImageFile read_by_openimageio(const std::string& format, ByteView bytes, const Reading& reading) {
  Opened opened = open(format, bytes, reading.limits);
  ImageFile file;
  file.facts = facts_of(format, bytes, opened);
  if (format == "jpeg" && !jpeg_is_complete(bytes)) {
    refuse("truncated JPEG file: it has no end of image");
  }
  if (format == "png" && !png_is_complete(bytes)) {
    refuse("truncated PNG file: its chunks do not run to IEND");
  }
  if (format != "tiff") opened.stored.premultiplied = 0;
  try {
    file.image = read_pixels(opened, pick(file.facts.channels, reading), format, reading);
  } catch (const std::bad_alloc&) {
    refuse("too large for memory");
  }
  if (opened.stored.premultiplied != 0) {
    file.facts.notes.emplace_back("colour was stored multiplied by alpha; it was divided");
  }
  file.image = oriented(std::move(file.image), opened.stored.orientation);
  return file;
}

}  // namespace kiln::io

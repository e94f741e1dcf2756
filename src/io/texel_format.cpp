// SPDX-License-Identifier: Apache-2.0
#include "texel_format.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

#include "kiln/core/error.h"
#include "packed_texel.h"
#include "samples.h"
#include "zstd_bytes.h"

namespace kiln::io {
namespace {

// The plane of each channel of memory, nullptr for X, in the order of kiln's images.
std::vector<std::string> channel_names(const TexelFormat& format) {
  std::vector<std::string> names;
  for (const char c : format.channels) {
    if (c != 'X') names.emplace_back(1, c);
  }
  std::stable_sort(names.begin(), names.end(),
                   [](const auto& a, const auto& b) { return channel_rank(a) < channel_rank(b); });
  return names;
}

std::vector<Plane*> planes_in_memory_order(const TexelFormat& format, Layers& image) {
  std::vector<Plane*> planes;
  for (const char c : format.channels) {
    const auto at = std::find_if(image.layers.begin(), image.layers.end(),
                                 [c](const Layer& layer) { return layer.name[0] == c; });
    planes.push_back(at == image.layers.end() ? nullptr : &at->plane);
  }
  return planes;
}

void swap_samples(std::vector<std::byte>& row, size_t sample) {
  for (size_t i = 0; i + sample <= row.size(); i += sample) {
    std::reverse(row.begin() + static_cast<std::ptrdiff_t>(i),
                 row.begin() + static_cast<std::ptrdiff_t>(i + sample));
  }
}

void place_row(const std::vector<std::byte>& row, const TexelFormat& format, int y,
               const std::vector<Plane*>& planes) {
  const size_t width = row.size() / texel_bytes(format);
  const PixelType type = coded_as(format.coding);
  if (!is_packed(type)) {
    for (size_t c = 0; c < planes.size(); ++c) {
      if (planes[c] == nullptr) continue;
      load_samples(row.data() + c * sample_bytes(type), type, planes.size(),
                   {planes[c]->row(y), width});
    }
    return;
  }
  for (size_t x = 0; x < width; ++x) {
    uint32_t bits = 0;
    std::memcpy(&bits, row.data() + 4 * x, sizeof bits);
    const std::array<float, 4> texel = unpacked(bits, type);
    for (size_t c = 0; c < planes.size(); ++c) {
      if (planes[c] != nullptr) planes[c]->row(y)[x] = texel[c];
    }
  }
}

// Bytes of a level: all its layers, faces and slices. @error when it has more texels than allowed
size_t level_bytes(const StoredTexels& stored, const ReadLimits& limits) {
  long long texels = 1;
  for (const long long count :
       {stored.width, stored.height, stored.depth, stored.layers, stored.faces}) {
    if (count < 1 || texels > limits.max_texels / count) {
      throw Error(Fault::Input,
                  fmt::format("the header claims {} x {} x {} texels, {} layers and {} faces; more "
                              "than {} texels are not read",
                              stored.width, stored.height, stored.depth, stored.layers,
                              stored.faces, limits.max_texels));
    }
    texels *= count;
  }
  return static_cast<size_t>(texels) * texel_bytes(stored.texel);
}

// The part of the file that holds the supercompressed level.
ByteView stored_level(const StoredTexels& stored, ByteView bytes, const ReadLimits& limits) {
  const size_t texels = level_bytes(stored, limits);
  if (stored.first > bytes.size() || stored.stored_bytes > bytes.size() - stored.first ||
      !zstd_may_hold(stored.stored_bytes, texels)) {
    throw Error(Fault::Input,
                fmt::format("truncated: the header claims {} bytes of texels in {} bytes", texels,
                            stored.stored_bytes));
  }
  return bytes.subspan(stored.first, stored.stored_bytes);
}

// @error when the texels do not lie within the bytes
void check_bytes(const StoredTexels& stored, ByteView bytes) {
  const auto rows = static_cast<unsigned long long>(stored.height * stored.depth);
  const unsigned long long row_bytes =
      static_cast<unsigned long long>(stored.width) * texel_bytes(stored.texel);
  const size_t left = bytes.size() - std::min(stored.first, bytes.size());
  if (stored.row_pitch < row_bytes || left < row_bytes ||
      (rows - 1) > (left - row_bytes) / stored.row_pitch) {
    throw Error(
        Fault::Input,
        fmt::format("truncated: the header claims {} x {} x {} texels of {} bytes, {} "
                    "bytes follow",
                    stored.width, stored.height, stored.depth, texel_bytes(stored.texel), left));
  }
}

std::vector<std::string> what_is_left(const StoredTexels& stored) {
  std::vector<std::string> notes;
  if (stored.faces > 1) notes.emplace_back("a cube; its first face is read");
  if (stored.layers > 1) {
    notes.push_back(fmt::format("an array of {}; the first is read", stored.layers));
  }
  if (stored.levels > 1) {
    notes.push_back(fmt::format("{} mip levels; the largest is read", stored.levels));
  }
  return notes;
}

}  // namespace

size_t texel_bytes(const TexelFormat& format) {
  const PixelType type = coded_as(format.coding);
  return is_packed(type) ? 4 : format.channels.size() * sample_bytes(type);
}

PixelType coded_as(Coding coding) {
  switch (coding) {
    case Coding::Unorm8:
      return PixelType::Uint8;
    case Coding::Unorm16:
      return PixelType::Uint16;
    case Coding::Half:
      return PixelType::Half;
    case Coding::Rgb10a2:
      return PixelType::Rgb10a2;
    case Coding::Float:
      return PixelType::Float;
    case Coding::R11g11b10f:
      return PixelType::B10g11r11;
    case Coding::Rgb9e5:
      return PixelType::E5b9g9r9;
  }
  return PixelType::Float;
}

PixelType held_as(Coding coding) {
  const PixelType type = coded_as(coding);
  if (type == PixelType::B10g11r11) return PixelType::Half;
  return type == PixelType::E5b9g9r9 ? PixelType::Float : type;
}

FileFacts facts_of_texels(const StoredTexels& stored, ByteView bytes, const ReadLimits& limits) {
  const std::vector<std::string> names = channel_names(stored.texel);
  if (stored.depth < 1 || stored.depth > limits.max_texels ||
      stored.height > limits.max_texels / stored.depth) {
    throw Error(Fault::Input,
                fmt::format("the header claims {} x {} x {} texels; more than {} are "
                            "not read",
                            stored.width, stored.height, stored.depth, limits.max_texels));
  }
  require_within(limits, stored.width, stored.height * stored.depth,
                 static_cast<long long>(names.size()));
  if (stored.supercompression == Supercompression::None) {
    check_bytes(stored, bytes);
  } else {
    stored_level(stored, bytes, limits);
  }
  FileFacts facts;
  facts.format = stored.format;
  facts.size = {static_cast<int>(stored.width), static_cast<int>(stored.height * stored.depth)};
  facts.channels = names;
  facts.type = held_as(stored.texel.coding);
  if (stored.texel.srgb) facts.color_space_tag = "srgb_rec709_scene";
  facts.attributes = stored.attributes;
  facts.notes = what_is_left(stored);
  facts.notes.insert(facts.notes.end(), stored.notes.begin(), stored.notes.end());
  if (stored.depth > 1) {
    facts.notes.push_back(
        fmt::format("a volume: {} slices of {} x {} texels stand one below the other", stored.depth,
                    stored.width, stored.height));
  }
  return facts;
}

Bytes inflated_level(const StoredTexels& stored, ByteView bytes, const ReadLimits& limits) {
  return zstd_inflated(stored_level(stored, bytes, limits), level_bytes(stored, limits));
}

Volume read_texels(const StoredTexels& stored, ByteView bytes, const ReadLimits& limits) {
  if (stored.supercompression != Supercompression::None) {
    const Bytes level = inflated_level(stored, bytes, limits);
    StoredTexels plain = stored;
    plain.first = 0;
    plain.supercompression = Supercompression::None;
    return read_texels(plain, level, limits);
  }
  Volume volume;
  volume.depth = static_cast<int>(stored.depth);
  volume.file.facts = facts_of_texels(stored, bytes, limits);
  volume.file.image = make_layers(volume.file.facts.size, volume.file.facts.channels);
  const std::vector<Plane*> planes = planes_in_memory_order(stored.texel, volume.file.image);
  const auto height = static_cast<int>(stored.height);
  const size_t sample = sample_bytes(coded_as(stored.texel.coding));
  std::vector<std::byte> row(static_cast<size_t>(stored.width) * texel_bytes(stored.texel));
  for (int y = 0; y < volume.file.facts.size.height; ++y) {
    const size_t at = stored.first + static_cast<size_t>(y) * stored.row_pitch;
    std::memcpy(row.data(), bytes.data() + at, row.size());
    if (stored.big_endian) swap_samples(row, sample);
    const int in_slice = y % height;
    const int to = stored.rows_from_below ? y - in_slice + height - 1 - in_slice : y;
    place_row(row, stored.texel, to, planes);
  }
  return volume;
}

}  // namespace kiln::io

// SPDX-License-Identifier: Apache-2.0
#include "texel_pack.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <span>

#include "kiln/core/error.h"
#include "packed_texel.h"
#include "rgbd.h"
#include "samples.h"

namespace kiln::io {
namespace {

static_assert(std::endian::native == std::endian::little, "samples are stored as they stand");

float filling(size_t channel) { return channel == 3 ? 1.0f : 0.0f; }

float value_at(const StoredPlanes& stored, size_t channel, int x, int y) {
  const bool absent = channel >= stored.planes.size() || stored.planes[channel] == nullptr;
  return absent ? filling(channel) : stored.planes[channel]->at(x, y);
}

std::string packed_words(Size size, const StoredPlanes& stored, PixelType type, WriteFacts& facts) {
  std::string bytes(static_cast<size_t>(area(size)) * sizeof(uint32_t), '\0');
  char* at = bytes.data();
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x, at += sizeof(uint32_t)) {
      std::array<float, 4> texel{};
      for (size_t c = 0; c < texel.size(); ++c) texel[c] = value_at(stored, c, x, y);
      const uint32_t bits = packed(texel, type, facts);
      std::memcpy(at, &bits, sizeof bits);
    }
  }
  return bytes;
}

}  // namespace

std::string packed_texels(Size size, const StoredPlanes& stored, int channels, PixelType type,
                          WriteFacts& facts) {
  if (is_packed(type)) return packed_words(size, stored, type, facts);
  const auto step = static_cast<size_t>(channels);
  const size_t row_bytes = static_cast<size_t>(size.width) * step * sample_bytes(type);
  std::string bytes(row_bytes * static_cast<size_t>(size.height), '\0');
  auto* row = reinterpret_cast<std::byte*>(bytes.data());
  std::vector<float> constant(static_cast<size_t>(size.width));
  for (int y = 0; y < size.height; ++y, row += row_bytes) {
    for (size_t c = 0; c < step; ++c) {
      const bool absent = c >= stored.planes.size() || stored.planes[c] == nullptr;
      if (absent) std::fill(constant.begin(), constant.end(), filling(c));
      const std::span<const float> texels =
          absent ? std::span<const float>(constant) : stored.planes[c]->texels_of_row(y);
      store_samples(texels, type, step, row + c * sample_bytes(type), facts);
    }
  }
  return bytes;
}

Layers rgbd_image(Size size, const StoredPlanes& stored, WriteFacts& facts) {
  Layers image = make_layers(size, {"R", "G", "B", "A"});
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      std::array<float, 3> color{};
      for (size_t c = 0; c < 3; ++c) color[c] = value_at(stored, c, x, y);
      const std::array<float, 4> texel = rgbd_texel(color, facts);
      for (size_t c = 0; c < 4; ++c) image.layers[c].plane.at(x, y) = texel[c];
    }
  }
  return image;
}

void require_room(const StoredPlanes& stored, PixelType type) {
  const bool colors_only =
      type == PixelType::Rgbd8 || type == PixelType::B10g11r11 || type == PixelType::E5b9g9r9;
  const size_t most = colors_only ? 3 : type == PixelType::Rgb10a2 ? 4 : stored.planes.size();
  if (stored.planes.size() <= most && (!colors_only || stored.alpha_channel < 0)) return;
  throw Error(Fault::Usage,
              fmt::format("found {} channels; {} holds 1 to {}{}", stored.planes.size(),
                          pixel_type_name(type), most,
                          type == PixelType::Rgbd8 ? ", its alpha is a divisor of theirs"
                          : colors_only            ? " and no alpha"
                                                   : ""));
}

size_t packed_texel_bytes(PixelType type, int channels) {
  return is_packed(type) ? sizeof(uint32_t) : static_cast<size_t>(channels) * sample_bytes(type);
}

}  // namespace kiln::io

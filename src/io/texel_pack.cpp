// SPDX-License-Identifier: Apache-2.0
#include "texel_pack.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <span>

#include "samples.h"

namespace kiln::io {
namespace {

static_assert(std::endian::native == std::endian::little, "samples are stored as they stand");

float filling(size_t channel) { return channel == 3 ? 1.0f : 0.0f; }

float value_at(const StoredPlanes& stored, size_t channel, int x, int y) {
  const bool absent = channel >= stored.planes.size() || stored.planes[channel] == nullptr;
  return absent ? filling(channel) : stored.planes[channel]->at(x, y);
}

std::string rgb10a2_texels(Size size, const StoredPlanes& stored, WriteFacts& facts) {
  std::string bytes(static_cast<size_t>(area(size)) * 4, '\0');
  char* at = bytes.data();
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x, at += 4) {
      uint32_t texel = quantised(value_at(stored, 3, x, y), 3, facts) << 30;
      for (size_t c = 0; c < 3; ++c) {
        texel |= quantised(value_at(stored, c, x, y), 1023, facts) << (10 * c);
      }
      std::memcpy(at, &texel, sizeof texel);
    }
  }
  return bytes;
}

// Largest value that a = 1 holds.
constexpr float rgbd_max = 255.0f;

float held_by_rgbd(float value, WriteFacts& facts) {
  if (std::isnan(value)) {
    ++facts.not_a_number;
    return 0.0f;
  }
  if (std::isfinite(value) && (value < 0.0f || value > rgbd_max)) count_clamped(value, facts);
  return std::clamp(value, 0.0f, rgbd_max);
}

// The largest a with max * a <= 255, and colours (value * a / 255)^(1/2.2), in bytes over 255.
std::array<float, 4> rgbd(const std::array<float, 3>& color) {
  const float max = std::max({color[0], color[1], color[2], 1.0f});
  const float a = std::floor(255.0f / max);
  std::array<float, 4> texel{0.0f, 0.0f, 0.0f, a / 255.0f};
  for (size_t c = 0; c < 3; ++c) {
    texel[c] = std::min(1.0f, std::pow(color[c] * a / 255.0f, 1.0f / 2.2f));
  }
  return texel;
}

}  // namespace

std::string packed_texels(Size size, const StoredPlanes& stored, int channels, PixelType type,
                          WriteFacts& facts) {
  if (type == PixelType::Rgb10a2) return rgb10a2_texels(size, stored, facts);
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
      for (size_t c = 0; c < 3; ++c) color[c] = held_by_rgbd(value_at(stored, c, x, y), facts);
      const std::array<float, 4> texel = rgbd(color);
      for (size_t c = 0; c < 4; ++c) image.layers[c].plane.at(x, y) = texel[c];
    }
  }
  return image;
}

StoredPlanes planes_of(const Layers& image) {
  StoredPlanes stored;
  for (const Layer& layer : image.layers) {
    stored.planes.push_back(&layer.plane);
    stored.names.push_back(layer.name);
  }
  if (stored.planes.size() == 4) stored.alpha_channel = 3;
  return stored;
}

}  // namespace kiln::io

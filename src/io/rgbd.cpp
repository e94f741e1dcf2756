// SPDX-License-Identifier: Apache-2.0
#include "rgbd.h"

#include <algorithm>
#include <cmath>

#include "samples.h"

namespace kiln::io {
namespace {

constexpr float gamma = 2.2f;
// What the smallest divisor, 1 of 255, holds.
constexpr float largest = 255.0f;

}  // namespace

// The largest a with max * a <= 255, and colours (value * a / 255)^(1/2.2), in bytes over 255.
std::array<float, 4> rgbd_texel(const std::array<float, 3>& color, WriteFacts& facts) {
  std::array<float, 3> inside{};
  for (size_t c = 0; c < 3; ++c) inside[c] = clamped(color[c], largest, facts);
  const float max = std::max({inside[0], inside[1], inside[2], 1.0f});
  const float a = std::floor(255.0f / max);
  std::array<float, 4> texel{0.0f, 0.0f, 0.0f, a / 255.0f};
  for (size_t c = 0; c < 3; ++c) {
    texel[c] = std::min(1.0f, std::pow(inside[c] * a / 255.0f, 1.0f / gamma));
  }
  return texel;
}

std::array<float, 3> rgbd_color(const std::array<float, 4>& texel) {
  std::array<float, 3> color{};
  for (size_t c = 0; c < 3; ++c) color[c] = std::pow(texel[c], gamma) / texel[3];
  return color;
}

}  // namespace kiln::io

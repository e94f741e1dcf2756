// SPDX-License-Identifier: Apache-2.0
#include "packed_texel.h"

#include <algorithm>
#include <cmath>

#include "samples.h"

namespace kiln::io {
namespace {

constexpr int exponent_bias = 15;
constexpr int shared_mantissa_bits = 9;
constexpr int largest_exponent = 31;

// 5 bits of exponent over `mantissa_bits` of mantissa; no sign.
float small_float(uint32_t bits, int mantissa_bits) {
  const uint32_t exponent = bits >> mantissa_bits & 31;
  const uint32_t mantissa = bits & ((1u << mantissa_bits) - 1);
  if (exponent == 31) return mantissa == 0 ? INFINITY : NAN;
  const auto value = static_cast<float>(mantissa);
  if (exponent == 0) return std::ldexp(value, 1 - exponent_bias - mantissa_bits);
  return std::ldexp(value + static_cast<float>(1u << mantissa_bits),
                    static_cast<int>(exponent) - exponent_bias - mantissa_bits);
}

float largest_small_float(int mantissa_bits) {
  return std::ldexp(2.0f - std::ldexp(1.0f, -mantissa_bits), largest_exponent - 1 - exponent_bias);
}

// Below 2^-14 numbers are multiples of the smallest one. A mantissa that rounds up to a power of
// two adds one to the exponent above it, as it should.
uint32_t small_float_bits(float value, int mantissa_bits, WriteFacts& facts) {
  const float inside = clamped(value, largest_small_float(mantissa_bits), facts);
  constexpr int least = 1 - exponent_bias;
  const int exponent = inside > 0.0f ? std::max(std::ilogb(inside), least) : least;
  const float mantissa = std::nearbyint(std::ldexp(inside, mantissa_bits - exponent));
  const auto steps = static_cast<uint32_t>(mantissa);
  return (static_cast<uint32_t>(exponent - least) << mantissa_bits) + steps;
}

// The biased exponent with which `largest`, rounded, has 9 bits.
int shared_exponent(double largest) {
  const int log2 = largest > 0 ? std::ilogb(largest) : -exponent_bias - 1;
  const int exponent = std::max(-exponent_bias - 1, log2) + 1 + exponent_bias;
  const double mantissa =
      std::floor(std::ldexp(largest, exponent_bias + shared_mantissa_bits - exponent) + 0.5);
  return mantissa < (1 << shared_mantissa_bits) ? exponent : exponent + 1;
}

}  // namespace

uint32_t packed_rgb10a2(const std::array<float, 4>& texel, WriteFacts& facts) {
  uint32_t bits = quantised(texel[3], 3, facts) << 30;
  for (size_t c = 0; c < 3; ++c) bits |= quantised(texel[c], 1023, facts) << (10 * c);
  return bits;
}

std::array<float, 4> unpacked_rgb10a2(uint32_t bits) {
  std::array<float, 4> texel{};
  for (size_t c = 0; c < 3; ++c) {
    texel[c] = static_cast<float>(bits >> (10 * c) & 1023) / 1023.0f;
  }
  texel[3] = static_cast<float>(bits >> 30) / 3.0f;
  return texel;
}

uint32_t packed_b10g11r11(const std::array<float, 4>& texel, WriteFacts& facts) {
  return small_float_bits(texel[0], 6, facts) | small_float_bits(texel[1], 6, facts) << 11 |
         small_float_bits(texel[2], 5, facts) << 22;
}

std::array<float, 4> unpacked_b10g11r11(uint32_t bits) {
  return {small_float(bits & 2047, 6), small_float(bits >> 11 & 2047, 6),
          small_float(bits >> 22, 5), 1.0f};
}

uint32_t packed_e5b9g9r9(const std::array<float, 4>& texel, WriteFacts& facts) {
  constexpr float largest_value = 65408.0f;  // 511/512 2^16
  std::array<double, 3> inside{};
  for (size_t c = 0; c < 3; ++c) inside[c] = clamped(texel[c], largest_value, facts);
  const int exponent = shared_exponent(std::max({inside[0], inside[1], inside[2]}));
  auto bits = static_cast<uint32_t>(exponent) << 27;
  for (size_t c = 0; c < 3; ++c) {
    const double mantissa =
        std::floor(std::ldexp(inside[c], exponent_bias + shared_mantissa_bits - exponent) + 0.5);
    bits |= static_cast<uint32_t>(mantissa) << (9 * c);
  }
  return bits;
}

std::array<float, 4> unpacked_e5b9g9r9(uint32_t bits) {
  const int exponent = static_cast<int>(bits >> 27) - exponent_bias - shared_mantissa_bits;
  std::array<float, 4> texel{0.0f, 0.0f, 0.0f, 1.0f};
  for (size_t c = 0; c < 3; ++c) {
    texel[c] = std::ldexp(static_cast<float>(bits >> (9 * c) & 511), exponent);
  }
  return texel;
}

uint32_t packed(const std::array<float, 4>& texel, PixelType type, WriteFacts& facts) {
  if (type == PixelType::B10g11r11) return packed_b10g11r11(texel, facts);
  if (type == PixelType::E5b9g9r9) return packed_e5b9g9r9(texel, facts);
  return packed_rgb10a2(texel, facts);
}

std::array<float, 4> unpacked(uint32_t bits, PixelType type) {
  if (type == PixelType::B10g11r11) return unpacked_b10g11r11(bits);
  if (type == PixelType::E5b9g9r9) return unpacked_e5b9g9r9(bits);
  return unpacked_rgb10a2(bits);
}

}  // namespace kiln::io

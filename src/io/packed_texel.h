// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "kiln/io/image_file.h"

/// Texels of three or four channels in 32 bits, the first channel lowest.
namespace kiln::io {

/// R, G, B and A of [0,1] in 10, 10, 10 and 2 bits, clamped and counted as `quantised` does.
uint32_t packed_rgb10a2(const std::array<float, 4>& texel, WriteFacts& facts);
std::array<float, 4> unpacked_rgb10a2(uint32_t bits);

/// R, G, B as PixelType::B10g11r11 has them, each rounded to the nearest, ties to even; clamped to
/// [0, 65024] ([0, 64512] for B) and counted. NaN becomes 0 and is counted, Inf the largest.
/// @source Khronos Data Format Specification 1.3, 10.2 and 10.3 (unsigned 11 and 10 bit floats)
uint32_t packed_b10g11r11(const std::array<float, 4>& texel, WriteFacts& facts);
/// The fourth is 1.
std::array<float, 4> unpacked_b10g11r11(uint32_t bits);

/// R, G, B as PixelType::E5b9g9r9 has them: the smallest exponent with which the largest of them,
/// rounded, has 9 bits; each rounded to the nearest, ties up. Clamped to [0, 65408] and counted;
/// NaN becomes 0 and is counted, Inf the largest.
/// @source EXT_texture_shared_exponent, section 3.8.1
uint32_t packed_e5b9g9r9(const std::array<float, 4>& texel, WriteFacts& facts);
/// The fourth is 1.
std::array<float, 4> unpacked_e5b9g9r9(uint32_t bits);

/// The function above for `type`. @valid is_packed(type)
uint32_t packed(const std::array<float, 4>& texel, PixelType type, WriteFacts& facts);
std::array<float, 4> unpacked(uint32_t bits, PixelType type);

}  // namespace kiln::io

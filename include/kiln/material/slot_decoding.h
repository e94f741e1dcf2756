// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>

#include "kiln/material/anisotropy.h"

namespace kiln {

/// What the numbers of a roughness map are.
///
///     perceptual  roughness as it is
///     alpha       alpha = roughness^2, the width of the lobe
enum class RoughnessEncoding { Perceptual, Alpha };
inline constexpr std::array<std::string_view, 2> roughness_encoding_names = {"perceptual", "alpha"};

/// What an angle of anisotropy is stored as.
///
///     turns      1 is a whole turn
///     degrees    360 is
///     radians    2 pi is
///     direction  two channels hold the vector of the wider axis as (v + 1) / 2, +y up
enum class AngleEncoding { Turns, Degrees, Radians, Direction };
inline constexpr std::array<std::string_view, 4> angle_encoding_names = {"turns", "degrees",
                                                                         "radians", "direction"};

/// How the stored numbers of a slot come to what the slot means. An encoding counts for its own
/// slot only; then value = scale * stored + offset. Of a normal map, x and y are scaled once they
/// are components, and of an angle [rad] is offset and its scale is 1.
struct SlotDecoding {
  RoughnessEncoding roughness = RoughnessEncoding::Perceptual;
  AnisotropyEncoding anisotropy = AnisotropyEncoding::Burley;
  AngleEncoding angle = AngleEncoding::Turns;
  std::array<float, 3> scale = {1, 1, 1};
  std::array<float, 3> offset = {0, 0, 0};
};

}  // namespace kiln

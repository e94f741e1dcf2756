// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "kiln/math/wide.h"

namespace kiln {

// Randomised quasi-Monte Carlo: the first four dimensions of the Sobol' sequence, each scrambled by
// a hash that permutes the bits as Owen's nested scrambling does. Points of a power-of-two prefix
// stay stratified whatever the seed, and different seeds are independent repetitions.

template <class U>
U reverse_bits(U x) {
  x = ((x >> 1) & U(0x55555555u)) | ((x & U(0x55555555u)) << 1);
  x = ((x >> 2) & U(0x33333333u)) | ((x & U(0x33333333u)) << 2);
  x = ((x >> 4) & U(0x0f0f0f0fu)) | ((x & U(0x0f0f0f0fu)) << 4);
  x = ((x >> 8) & U(0x00ff00ffu)) | ((x & U(0x00ff00ffu)) << 8);
  return (x >> 16) | (x << 16);
}

/// Owen scrambling of a number whose bits are already reversed; returns bits in natural order.
/// @source Burley 2020, "Practical Hash-based Owen Scrambling" (Laine-Karras style hash)
template <class U>
U owen_scramble_reversed(U x, U seed) {
  x = x + seed;
  x = x ^ (x * U(0x6c50b47cu));
  x = x ^ (x * U(0xb82f1e52u));
  x = x ^ (x * U(0xc7afe638u));
  x = x ^ (x * U(0x8d22f6e6u));
  return reverse_bits(x);
}

/// The top 23 bits as a float in (0, 1): never 0, never 1.
inline float unit_float(std::uint32_t bits) {
  return static_cast<float>((bits >> 9) + 0.5) * 0x1p-23f;
}
inline WideFloat unit_float(WideUint bits) {
  const WideUint one_to_two = (bits >> 9) | WideUint(0x3f800000u);
  return float_of_bits(one_to_two) - WideFloat(1.0f - 0x1p-24f);
}

/// Sobol' points with reversed bits, ready for owen_scramble_reversed: [n] of four dimensions.
using SobolPoints = std::vector<std::array<std::uint32_t, 4>>;

/// @valid  n >= 0
/// @source Joe and Kuo 2008 (direction numbers of the first four dimensions)
SobolPoints sobol_points_reversed(int n);

}  // namespace kiln

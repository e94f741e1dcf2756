// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace kiln {

/// A well mixed 32-bit hash; of std::uint32_t or of a wide unsigned number.
/// @source "lowbias32" constants found by Wellons' hash prospector (2018)
template <class U>
U mix_bits(U x) {
  x = x ^ (x >> 16);
  x = x * U(0x7feb352du);
  x = x ^ (x >> 15);
  x = x * U(0x846ca68bu);
  x = x ^ (x >> 16);
  return x;
}

template <class U>
U combine_hash(U seed, U value) {
  return mix_bits<U>(seed ^ (value + U(0x9e3779b9u) + (seed << 6) + (seed >> 2)));
}

}  // namespace kiln

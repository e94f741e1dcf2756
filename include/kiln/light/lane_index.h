// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "kiln/math/wide.h"

namespace kiln {

// Indices into tables, lane for lane beside a float type.

template <class F>
struct LaneIndexOf {
  using type = std::int32_t;
};
template <>
struct LaneIndexOf<WideFloat> {
  using type = WideInt;
};
template <class F>
using LaneIndex = typename LaneIndexOf<F>::type;

/// x with NaN and anything below 0 as 0, and nothing above `last`.
template <class F>
F clamp_to_table(F x, float last) {
  return min(select(x > F(0), x, F(0)), F(last));
}

/// The integer at or below x; x >= 0 and finite.
template <class F>
LaneIndex<F> to_index(F x) {
  if constexpr (lane_count<F> == 1) {
    return static_cast<std::int32_t>(x);
  } else {
    return xsimd::to_int(x);
  }
}

template <class F>
F from_index(LaneIndex<F> index) {
  if constexpr (lane_count<F> == 1) {
    return static_cast<F>(index);
  } else {
    return xsimd::to_float(index);
  }
}

template <class F>
LaneIndex<F> select_index(MaskOf<F> condition, LaneIndex<F> yes, LaneIndex<F> no) {
  if constexpr (lane_count<F> == 1) {
    return condition ? yes : no;
  } else {
    return xsimd::select(xsimd::bool_cast(condition), yes, no);
  }
}

/// table[index] as F; every lane's index must be inside the table.
template <class F>
F table_at(const float* table, LaneIndex<F> index) {
  return F(gather(table, index));
}
inline std::int32_t index_at(const std::int32_t* table, std::int32_t index) { return table[index]; }
inline WideInt index_at(const std::int32_t* table, WideInt index) {
  return WideInt::gather(table, index);
}

}  // namespace kiln

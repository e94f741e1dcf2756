// SPDX-License-Identifier: Apache-2.0
#pragma once

// One text, three number types. Formulas are templates on F; F is double (the oracle, and tables),
// float (the reference) or a wide number (texels and samples). This is the one header in which a
// third-party type shows: the wide number is xsimd's batch.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <type_traits>
#include <xsimd/xsimd.hpp>

namespace kiln {

using WideFloat = xsimd::batch<float>;
using WideDouble = xsimd::batch<double>;
using WideUint = xsimd::batch<std::uint32_t>;
using WideInt = xsimd::batch<std::int32_t>;

/// What a number type is made of: its scalar, its mask and how many lanes it has.
template <class F>
struct Lanes {
  using Scalar = F;
  using Mask = bool;
  using Uint = std::uint32_t;
  static constexpr int count = 1;
};
template <class T, class A>
struct Lanes<xsimd::batch<T, A>> {
  using Scalar = T;
  using Mask = xsimd::batch_bool<T, A>;
  using Uint = xsimd::batch<std::uint32_t, A>;
  static constexpr int count = static_cast<int>(xsimd::batch<T, A>::size);
};

template <class F>
using ScalarOf = typename Lanes<F>::Scalar;
template <class F>
using MaskOf = typename Lanes<F>::Mask;
/// Unsigned integers beside F, lane for lane (float types only).
template <class F>
using UintOf = typename Lanes<F>::Uint;
template <class F>
inline constexpr int lane_count = Lanes<F>::count;

// Scalars find these names here, wide numbers find xsimd's by their argument.
using std::abs;
using std::atan2;
using std::ceil;
using std::copysign;
using std::cos;
using std::exp;
using std::expm1;
using std::floor;
using std::fma;
using std::isnan;
using std::log;
using std::log1p;
using std::max;
using std::min;
using std::pow;
using std::sin;
using std::sqrt;

template <class F>
requires std::is_arithmetic_v<F>
constexpr F select(bool condition, F yes, F no) { return condition ? yes : no; }
inline bool any(bool condition) { return condition; }
inline bool all(bool condition) { return condition; }

template <class F>
F square(F x) {
  return x * x;
}

/// x^5 by three multiplications.
template <class F>
F pow5(F x) {
  const F x2 = x * x;
  return x2 * x2 * x;
}

template <class F>
F clamp(F x, F low, F high) {
  return min(max(x, low), high);
}

template <class F>
F lerp(F a, F b, F t) {
  return fma(t, b - a, a);
}

/// sqrt of x, 0 where x < 0 (rounding below zero).
template <class F>
F safe_sqrt(F x) {
  return sqrt(max(x, F(0)));
}

/// Loads / stores lane_count<F> values; `from` and `to` need no alignment. (Plain load and store
/// would lose to xsimd's own, which want aligned memory.)
template <class F>
F load_lanes(const ScalarOf<F>* from) {
  if constexpr (lane_count<F> == 1) {
    return *from;
  } else {
    return F::load_unaligned(from);
  }
}
template <class F>
void store_lanes(ScalarOf<F>* to, F value) {
  if constexpr (lane_count<F> == 1) {
    *to = value;
  } else {
    value.store_unaligned(to);
  }
}

/// table[index] lane for lane; every lane's index must be inside the table.
inline float gather(const float* table, std::int32_t index) { return table[index]; }
inline WideFloat gather(const float* table, WideInt index) {
  // The processor's own gather, which xsimd 8.1's WideFloat::gather does not reach.
  return xsimd::kernel::gather<WideFloat::arch_type>(table, index, WideFloat::arch_type{});
}

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

/// The float whose bits these are.
inline WideFloat float_of_bits(WideUint bits) { return xsimd::bitwise_cast<WideFloat>(bits); }

inline constexpr double pi = 3.14159265358979323846;

}  // namespace kiln

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "kiln/core/zeroed_allocator.h"
#include "kiln/image/layers.h"
#include "kiln/math/vec.h"
#include "kiln/math/wide.h"

namespace kiln {

/// What lies beyond the first and the last row of a lat-long image.
enum class Pole { Clamped, AcrossByHalfATurn };

/// A lat-long image laid out for gathers: R, G, B and one more number per texel side by side, with
/// a border of one texel that wraps around, so that a bilinear lookup needs no case at all.
class LatLongTexels {
 public:
  LatLongTexels() = default;
  /// @param columns  columns to take from the image, from the left (node-aligned images repeat one)
  LatLongTexels(const Layers& image, int columns, Pole pole);

  Size size() const { return size_; }

  /// Bilinear value at a point in texels of the bordered image: texel (x, y) has its centre at
  /// (x + 1, y + 1). Any point, NaN too, is safe.
  template <class F>
  Vec3<F> bilinear(Vec2<F> at) const {
    const auto width = static_cast<float>(size_.width), height = static_cast<float>(size_.height);
    const F x = clamp_to_table(at.x, width + 1), y = clamp_to_table(at.y, height + 1);
    const F left = min(floor(x), F(width)), top = min(floor(y), F(height));
    const LaneIndex<F> first = index_of<F>(to_index<F>(left), to_index<F>(top));
    const Vec3<F> upper = along_row(first, x - left);
    const Vec3<F> lower = along_row(LaneIndex<F>(first + LaneIndex<F>(4 * stride_)), x - left);
    return upper + (lower - upper) * (y - top);
  }

  /// The fourth number of texel (x, y) of the bordered image.
  template <class F>
  F fourth(LaneIndex<F> x, LaneIndex<F> y) const {
    return table_at<F>(texels_.data() + 3, index_of<F>(x, y));
  }
  void set_fourth(int x, int y, float value);

 private:
  template <class F>
  LaneIndex<F> index_of(LaneIndex<F> x, LaneIndex<F> y) const {
    return (y * LaneIndex<F>(stride_) + x) * LaneIndex<F>(4);
  }

  template <class F, class Index>
  Vec3<F> along_row(Index first, F t) const {
    const float* here = texels_.data();
    const Vec3<F> a{table_at<F>(here, first), table_at<F>(here + 1, first),
                    table_at<F>(here + 2, first)};
    const Vec3<F> b{table_at<F>(here + 4, first), table_at<F>(here + 5, first),
                    table_at<F>(here + 6, first)};
    return a + (b - a) * t;
  }

  void fill_row(const Layers& image, int from, int to, int turn);

  Size size_;
  int stride_ = 0;  ///< width of the bordered image
  std::vector<float, ZeroedAllocator<float>> texels_;
};

}  // namespace kiln

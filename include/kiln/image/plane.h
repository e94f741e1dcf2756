// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "kiln/core/size.h"
#include "kiln/core/zeroed_allocator.h"

namespace kiln {

/// One channel of an image: float32, row 0 at the top, texel centres at +0.5.
///
/// Rows are padded to whole vectors of `lane_pad` texels, so a kernel may read and write past the
/// last texel of a row up to the stride. The pad is scratch and never part of a result.
class Plane {
 public:
  static constexpr int lane_pad = 16;

  Plane() = default;
  explicit Plane(Size size)
      : size_(size),
        stride_((size.width + lane_pad - 1) / lane_pad * lane_pad),
        texels_(static_cast<size_t>(stride_) * static_cast<size_t>(size.height)) {}
  Plane(Size size, float value) : Plane(size) {
    if (value != 0.0f) std::fill(texels_.begin(), texels_.end(), value);
  }

  Size size() const { return size_; }
  int width() const { return size_.width; }
  int height() const { return size_.height; }
  int stride() const { return stride_; }
  bool empty() const { return texels_.empty(); }

  float* row(int y) { return texels_.data() + static_cast<size_t>(y) * stride_; }
  const float* row(int y) const { return texels_.data() + static_cast<size_t>(y) * stride_; }
  std::span<const float> texels_of_row(int y) const {
    return {row(y), static_cast<size_t>(size_.width)};
  }
  float& at(int x, int y) { return row(y)[x]; }
  float at(int x, int y) const { return row(y)[x]; }

 private:
  Size size_;
  int stride_ = 0;
  std::vector<float, ZeroedAllocator<float>> texels_;
};

}  // namespace kiln

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <vector>

#include "kiln/core/zeroed_allocator.h"
#include "kiln/math/vec.h"
#include "kiln/math/wide.h"

namespace kiln {

/// Four smooth functions of direction, sampled at the texel centres of a 2N x N lat-long grid with
/// a border that continues across the poles and around.
class SphereField {
 public:
  static constexpr int border = 4;

  explicit SphereField(int height);

  int height() const { return height_; }
  int width() const { return 2 * height_; }
  float* texel(int x, int y) { return values_.data() + index_of(x, y); }

  /// Copies what lies across; to be called when all texels are written.
  void fill_border();

  /// The values at unit directions, by 8 x 8 Lagrange interpolation.
  void evaluate(std::span<const Vec3<double>> directions,
                std::span<std::array<float, 4>> values) const;

 private:
  size_t index_of(int x, int y) const {
    return (static_cast<size_t>(y + border) * static_cast<size_t>(width() + 2 * border) +
            static_cast<size_t>(x + border)) *
           4;
  }
  std::array<float, 4> interpolated(size_t corner, const float* across, const float* down) const;

  int height_;
  std::vector<float, ZeroedAllocator<float>> values_;
};

}  // namespace kiln

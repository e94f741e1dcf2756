// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

#include "kiln/image/plane.h"

namespace kiln {

/// Each axis halved, rounded down, at least 1.
Size next_level(Size size);

/// Sizes of a chain from `size` down to 1 x 1. @param most  of them; 0: all
std::vector<Size> level_sizes(Size size, int most = 0);

/// Rows of one level of a chain.
struct LevelRows {
  int level = 0;
  int first = 0;              ///< row of the level that is the planes' first
  std::vector<Plane> planes;  ///< one for each channel; none where there are no rows

  int rows() const { return planes.empty() ? 0 : planes.front().height(); }
};

/// Writes row y into the given rows, one for each channel. Called from several threads at once, for
/// some rows twice.
using FillRow = std::function<void(int y, float* const* channels)>;

/// The next level of an image whose rows come band by band: each texel is the exact area average of
/// its footprint, which is two texels along an even axis, and along an odd one of 2 n + 1 texels
/// three with the weights (n - i, n, i + 1) / (2 n + 1) for texel i of n. It looks across no edge,
/// so that wrapping, clamping and mirroring are all the same to it, and no weight is negative, so
/// that moments stay moments.
class AreaHalver {
 public:
  AreaHalver(Size from, int channels);

  /// Takes the next `rows` rows; returns those of the next level that are complete. The planes are
  /// never held whole, only what the row after them needs.
  LevelRows add(int rows, const FillRow& fill);

 private:
  struct Footprint {
    int first = 0, count = 0;
    float weights[3] = {};
  };
  Footprint rows_of(int y) const;
  int complete_rows() const;
  void make_rows(LevelRows& made, const FillRow& fill, int chunk, int chunks);
  void combine(const std::vector<float*>& rows, const Footprint& footprint, float* to) const;
  void keep_rest(const FillRow& fill);

  Size from_, to_;
  int channels_;
  int taken_ = 0, made_ = 0;         ///< rows
  std::vector<float> left_, right_;  ///< weights along a row of odd width
  int kept_first_ = 0;               ///< row of `from` that is the first of the kept
  std::vector<Plane> kept_;          ///< up to two rows that the next output row sees
  int kept_rows_ = 0;
  std::vector<std::vector<float>> scratch_;  ///< of each chunk of rows
};

/// All levels below an image whose rows come band by band, none of them held whole.
class MipCascade {
 public:
  /// @param sizes  of all levels, the image's own first
  MipCascade(const std::vector<Size>& sizes, int channels);

  /// Takes the next `rows` rows of the image; returns what is complete, level by level.
  std::vector<LevelRows> add(int rows, const FillRow& fill);

 private:
  std::vector<AreaHalver> halvers_;
};

/// The next level of a whole plane, as AreaHalver makes it.
Plane next_level(const Plane& plane);

}  // namespace kiln

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "kiln/image/plane.h"

namespace kiln {

/// Cosine-weighted visibility of a height map that repeats, texel by texel.
///
/// In each vertical plane through a texel the sky is seen between two horizons, which are looked
/// for along both directions; what a surface of the texel's own normal receives between them has a
/// closed form, and visibility is its mean over the planes.
///
/// @source   Jimenez et al. 2016, "Practical Real-Time Strategies for Accurate Indirect Occlusion"
/// @accuracy near texels are all looked at, those beyond 16 in steps that grow by a tenth: relief
///           narrower than a step may be missed there
class HorizonScan {
 public:
  struct Options {
    double height_scale = 1;  ///< between 0 and 1 of the map [texel]
    double radius = 64;       ///< how far is looked [texel]; at most the size of the map
    int directions = 16;      ///< even
  };
  HorizonScan(const Plane& height, const Options& options);

  Size size() const { return size_; }
  /// Visibility [0..1] of a row of texels, whose memory goes on to whole vectors.
  void visibility(int y, float* row) const;

 private:
  /// Where to look from a texel.
  struct Step {
    int dx, dy;
    float inverse_distance;  ///< times the scale of heights
  };
  struct Direction {
    double x, y;  ///< unit, y down
    std::vector<Step> steps;
  };

  const float* around(int x, int y) const;

  Size size_;
  int border_;     ///< columns that are repeated on both sides
  Plane heights_;  ///< with the border
  float scale_;
  std::vector<Direction> directions_;  ///< the second half opposite to the first
};

}  // namespace kiln

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

#include "kiln/bake/bake.h"
#include "kiln/integrate/sobol.h"
#include "kiln/parallel/rows.h"
#include "preview_pixels.h"

namespace kiln {

// How far a picture is sampled. Pictures are cut into fixed squares of block_edge pixels; each
// doubles its points until its own mean standard error is what is asked for, going on in the point
// set, so that nothing is thrown away. Which points a pixel gets depends on its block alone: the
// picture is the same for any number of threads.

inline constexpr int block_edge = 16;
static_assert(band_unit % block_edge == 0, "blocks lie within bands");

/// Points [first, last) of the set.
struct PointRange {
  int first = 0, last = 0;
};

/// What lane_count pixels have gathered, summed over points.
struct PixelSums {
  RepetitionSums light{};
  WideFloat carried = WideFloat(0.0f);  ///< of glass: throughput of the paths that left
  WideFloat trapped = WideFloat(0.0f);  ///< of glass: of which were ended inside
};

struct Sampling {
  int points = 0;           ///< of each repetition, at first
  int most = 0;             ///< never more than these
  double target_error = 0;  ///< 0: no more than at first
  int seed = 0;
  bool never_negative = false;  ///< what is estimated below 0 is noise, and stored as 0
};

/// Where a block lies and how its pixels are kept.
class PixelBlock {
 public:
  static constexpr int lanes = lane_count<WideFloat>;
  static constexpr int vectors = block_edge / std::min(lanes, block_edge);

  PixelBlock(Size picture, int index);

  /// Calls visit(x, y, sums) for every vector of pixels of which the image shows any.
  template <class Visit>
  void for_vectors(const Layers& image, const Visit& visit) {
    for (int y = first_y_; y < last_y_; ++y) {
      for (int v = 0; v < vectors; ++v) {
        const int x = first_x_ + v * lanes;
        if (x >= last_x_ || !covers_any(image, x, y)) continue;
        visit(x, y, sums_[static_cast<size_t>((y - first_y_) * vectors + v)]);
      }
    }
  }

  /// Over the pixels that are shown, plane 4 and the two after it.
  struct Errors {
    double sum = 0, shown = 0;
    double mean() const { return shown > 0 ? sum / (3 * shown) : 0; }
  };
  Errors errors(const Layers& image) const;
  void fill(Plane& plane, float value) const;

 private:
  int first_x_, first_y_, last_x_, last_y_;
  std::array<PixelSums, static_cast<size_t>(block_edge* vectors)> sums_{};
};

int block_count(Size picture);

/// How many of the pixels shown lie in blocks of a greater mean error than this.
double pixels_above(const Layers& image, double error);

/// The image whose planes are filled: R G B A, three of standard errors, points of each repetition.
Layers make_sampled_image(const Picture& picture);
inline constexpr size_t points_plane = 7;

/// Fills an image of make_sampled_image.
/// @param renderer  add(x, y, PointRange, PixelSums&) and finish(x, y, PixelSums, points)
template <class Renderer>
void sample_blocks(const Renderer& renderer, const Sampling& sampling, Layers& image) {
  for_rows(block_count(image.size), [&](int index) {
    PixelBlock block(image.size, index);
    PointRange range{0, sampling.points};
    while (true) {
      block.for_vectors(image, [&](int x, int y, PixelSums& sums) {
        renderer.add(x, y, range, sums);
        RepetitionSums means = sums.light;
        const WideFloat scale(1.0f / static_cast<float>(std::max(range.last, 1)));
        for (Vec3<WideFloat>& mean : means) mean = mean * scale;
        const Estimate estimate = summarise(means);
        store_color(image, 0, x, y,
                    sampling.never_negative ? not_negative(estimate.mean) : estimate.mean);
        store_color(image, 4, x, y, estimate.error);
      });
      const bool more = sampling.target_error > 0 && 2 * range.last <= sampling.most;
      if (!more || block.errors(image).mean() <= sampling.target_error) break;
      range = {range.last, 2 * range.last};
    }
    block.fill(image.layers[points_plane].plane, static_cast<float>(range.last));
    block.for_vectors(
        image, [&](int x, int y, PixelSums& sums) { renderer.finish(x, y, sums, range.last); });
  });
}

}  // namespace kiln

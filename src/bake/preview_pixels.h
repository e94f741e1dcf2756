// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "kiln/image/layers.h"
#include "kiln/integrate/sobol.h"
#include "kiln/math/hash.h"
#include "picture.h"

namespace kiln {

// What every way to render a picture shares: pixels in vectors of lanes, their seeds, their
// estimates from independent repetitions, their coverage.

/// Independent scramblings of the point set, from which standard errors are found.
inline constexpr int repetitions = 8;

struct Estimate {
  Vec3<WideFloat> mean, error;
};

/// Mean and standard error of the mean of independent repetitions.
Estimate summarise(const std::array<Vec3<WideFloat>, repetitions>& means);

inline Vec3<WideFloat> not_negative(const Vec3<WideFloat>& color) {
  const WideFloat zero(0.0f);
  return {max(color.x, zero), max(color.y, zero), max(color.z, zero)};
}

/// A hash of each pixel from x on.
WideUint texel_hashes(int x, int y, int seed);

/// Seeds of the four scrambled dimensions of one repetition at one texel.
template <class U>
std::array<U, 4> repetition_seeds(U texel, std::uint32_t repetition) {
  std::array<U, 4> seeds;
  for (std::uint32_t d = 0; d < 4; ++d) {
    seeds[d] = combine_hash<U>(texel, U(4 * repetition + d));
  }
  return seeds;
}

/// Four uniform numbers in [0,1) from a point of the set.
template <class F>
std::array<F, 4> scrambled(const std::array<std::uint32_t, 4>& point,
                           const std::array<UintOf<F>, 4>& seeds) {
  std::array<F, 4> u;
  for (size_t d = 0; d < 4; ++d) {
    u[d] = unit_float(owen_scramble_reversed<UintOf<F>>(UintOf<F>(point[d]), seeds[d]));
  }
  return u;
}

/// Points [first, last) of a set, to be scrambled anew for each repetition at each texel.
struct ScrambledPoints {
  const SobolPoints& set;
  int first, last;
  WideUint texels;  ///< hashes
};

using RepetitionSums = std::array<Vec3<WideFloat>, repetitions>;

/// Three planes from `first_plane` on, lane_count<WideFloat> pixels from x on.
void store_color(Layers& image, int first_plane, int x, int y, const Vec3<WideFloat>& color);

/// Plane 3, A.
void fill_coverage(const Picture& picture, Layers& image);

/// Whether any pixel of the vector at x shows the surface.
bool covers_any(const Layers& image, int x, int y);

/// Every number of a plane times `scale`.
void scale_plane(Plane& plane, float scale);

/// Off the ball there is no colour either.
void clear_background(const Picture& picture, Layers& image);

}  // namespace kiln

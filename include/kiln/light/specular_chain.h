// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "kiln/image/layers.h"
#include "kiln/image/projection.h"
#include "kiln/light/turn.h"
#include "kiln/math/vec.h"
#include "kiln/math/wide.h"

namespace kiln {

/// Position along a chain of a perceptual roughness in [0,1], l = r (2 - r): the inverse of the
/// filament curve, r = 1 - sqrt(1 - l).
template <class F>
F chain_position(F roughness) {
  return roughness * (F(2) - roughness);
}

struct ChainOptions {
  int size = 256;         ///< edge of the first level's faces [texel]
  double rotate_deg = 0;  ///< as of Environment; applied to lookups, not to the faces [degree]
};

/// A cube-mapped environment of halving sizes, each level filtered by a wider GGX lobe, to be
/// looked up at any roughness.
///
/// Level 0 is the environment itself (roughness 0), averaged over each texel's area. Every other
/// level is what Prefilter makes of it; roughness runs along the levels by the filament curve.
class SpecularChain {
 public:
  /// @param latlong  planes R G B (or one plane, grey), values at texel centres, finite
  /// @error Fault::Input when the image is empty or has neither one nor three colours,
  ///        Fault::Usage when options.size is not in [1, 4096]
  SpecularChain(const Layers& latlong, const ChainOptions& options);

  int levels() const { return static_cast<int>(sizes_.size()); }
  int size(int level) const { return sizes_[static_cast<size_t>(level)]; }
  double roughness(int level) const { return roughness_[static_cast<size_t>(level)]; }

  /// One face as planes R G B, in the orientation of the source image.
  Layers face(int level, CubeFace face) const;

  /// Trilinear lookup at the unit direction d, without seams; roughness in [0,1], perceptual.
  template <class F>
  Vec3<F> lookup(const Vec3<F>& d, F roughness) const;

  /// Bilinear lookup in one level.
  template <class F>
  Vec3<F> lookup_level(const Vec3<F>& d, int level) const {
    return bilinear(point_of(turn_.to_image(d)), LaneIndex<F>(level));
  }

 private:
  template <class F>
  struct Point {
    F face;
    F s, t;  ///< [-1,1], t down
  };
  template <class F>
  static Point<F> point_of(const Vec3<F>& d);
  template <class F>
  Vec3<F> bilinear(const Point<F>& point, LaneIndex<F> level) const;
  template <class F>
  Vec3<F> texel(LaneIndex<F> index) const {
    return {table_at<F>(texels_.data(), index), table_at<F>(texels_.data() + 1, index),
            table_at<F>(texels_.data() + 2, index)};
  }

  size_t texel_index(int level, int face, int x, int y) const;
  void store_level(int level, const std::vector<Layers>& faces);
  void fill_borders(int level);

  Turn turn_;
  std::vector<int> sizes_;
  std::vector<double> roughness_;
  std::vector<float> edges_;           ///< sizes_ as float, for gathers
  std::vector<std::int32_t> firsts_;   ///< [levels + 1] index of each level's first number
  std::vector<std::int32_t> strides_;  ///< edge of a face with its border
  std::vector<float> texels_;          ///< R G B and a pad; faces with a border of one texel
};

// The same choice among equals as direction_to_cube.
template <class F>
SpecularChain::Point<F> SpecularChain::point_of(const Vec3<F>& d) {
  const F ax = abs(d.x), ay = abs(d.y), az = abs(d.z);
  const auto on_x = (ax >= ay) & (ax >= az);
  const auto on_y = ay >= az;
  const auto x_up = d.x > F(0), y_up = d.y > F(0), z_up = d.z > F(0);
  const F major = select(on_x, ax, select(on_y, ay, az));
  const F face = select(on_x, select(x_up, F(0), F(1)),
                        select(on_y, select(y_up, F(2), F(3)), select(z_up, F(4), F(5))));
  const F s = select(on_x, select(x_up, -d.z, d.z), select(on_y, d.x, select(z_up, d.x, -d.x)));
  const F t = select(on_x, -d.y, select(on_y, select(y_up, d.z, -d.z), -d.y));
  const F inverse = F(1) / major;
  return {face, s * inverse, t * inverse};
}

template <class F>
Vec3<F> SpecularChain::bilinear(const Point<F>& point, LaneIndex<F> level) const {
  const F edge = table_at<F>(edges_.data(), level);
  const auto in_texels = [&](F at) {
    const F x = fma(at, F(0.5) * edge, fma(F(0.5), edge, F(0.5)));
    return min(select(x > F(0.5), x, F(0.5)), edge + F(0.5));
  };
  const F x = in_texels(point.s), y = in_texels(point.t);
  const F left = floor(x), top = floor(y);
  const LaneIndex<F> stride = index_at(strides_.data(), level);
  const LaneIndex<F> row = to_index<F>(point.face) * stride + to_index<F>(top);
  const LaneIndex<F> four(4);
  const LaneIndex<F> first =
      index_at(firsts_.data(), level) + (row * stride + to_index<F>(left)) * four;
  const LaneIndex<F> below = first + stride * four;
  const F tx = x - left;
  const Vec3<F> a = texel<F>(first), b = texel<F>(first + four);
  const Vec3<F> c = texel<F>(below), e = texel<F>(below + four);
  const Vec3<F> upper = a + (b - a) * tx, lower = c + (e - c) * tx;
  return upper + (lower - upper) * (y - top);
}

template <class F>
Vec3<F> SpecularChain::lookup(const Vec3<F>& d, F roughness) const {
  const auto last = static_cast<float>(levels() - 1);
  const F position = clamp_to_table(chain_position(roughness) * F(last), last);
  const F sharper = floor(position);
  const F rougher = min(sharper + F(1), F(last));
  const Point<F> point = point_of(turn_.to_image(d));
  const Vec3<F> a = bilinear(point, to_index<F>(sharper));
  const Vec3<F> b = bilinear(point, to_index<F>(rougher));
  return a + (b - a) * (position - sharper);
}

}  // namespace kiln

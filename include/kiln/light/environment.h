// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "kiln/image/layers.h"
#include "kiln/image/projection.h"
#include "kiln/light/angles.h"
#include "kiln/light/latlong_texels.h"
#include "kiln/light/radiance.h"
#include "kiln/math/vec.h"

namespace kiln {

/// What arrives from a direction, and how likely sample() is to choose it.
template <class F>
struct Arriving {
  Vec3<F> radiance;
  F density;  ///< [1/sr]
};

template <class F>
struct LightSample {
  Vec3<F> direction;  ///< unit, toward the light, world
  Vec3<F> radiance;
  F density;  ///< [1/sr]
};

struct EnvironmentOptions {
  bool node_aligned = false;  ///< first column = last, pole rows constant (OpenEXR envmaps): values
                              ///< are read at the nodes, without resampling
  double rotate_deg = 0;      ///< about +Y, positive turns +Z toward +X [degree]
};

/// A distant environment: directions to radiance, and directions sampled by importance.
///
/// Radiance is read bilinearly, wrapping around and clamped at the poles. Directions are drawn from
/// a density that is constant per cell of the lat-long grid,
///
///     density = share / (4 pi) + (1 - share) P(row) P(column | row) / (solid angle of the cell),
///
/// where P is proportional to the cell's mean luminance as read bilinearly (negative luminance
/// counts as zero) times its exact solid angle, and the uniform share makes the density positive
/// wherever there may be light. P is that of the rounded tables that are sampled, so no rounding
/// biases an estimate. Cells are the texels; of a node-aligned image, the squares between nodes.
class Environment {
 public:
  static constexpr double uniform_share = 0.01;

  /// @param latlong  planes R G B (or one plane, grey), finite
  /// @error Fault::Input when the image is empty, too small or has neither one nor three colours
  explicit Environment(const Layers& latlong, const EnvironmentOptions& options = {});

  /// Radiance from the unit direction d; any d, NaN too, reads inside the image.
  template <class F>
  Vec3<F> radiance(const Vec3<F>& d) const;

  /// Radiance at the point (u, v) in [0,1]^2 of the image, rotation not applied.
  template <class F>
  Vec3<F> radiance_in_image(Vec2<F> uv) const;

  /// Density of sample() at the unit direction d [1/sr].
  template <class F>
  F density(const Vec3<F>& d) const;

  /// Both of the above for the price of one.
  template <class F>
  Arriving<F> arriving(const Vec3<F>& d) const;

  /// A direction by importance; u in [0,1)^2, and neighbours in u stay neighbours in direction.
  template <class F>
  LightSample<F> sample(Vec2<F> u) const;

  /// Cells of the density, in the image's own orientation.
  Size cells() const { return cells_; }
  /// Whether values stand at the corners of cells instead of their middles.
  bool is_node_aligned() const { return offset_.x == 1; }
  double rotate_deg() const { return 360 * rotation_; }

 private:
  template <class F>
  struct Inverse {
    LaneIndex<F> index;
    F offset;  ///< [0,1) inside the interval
  };

  template <class F>
  static void descend(const float* cumulative, int steps, F u, LaneIndex<F>& at, F& low);
  template <class F>
  Inverse<F> find_row(F u) const;
  template <class F>
  Inverse<F> find_column(LaneIndex<F> row, F u) const;
  template <class F>
  Vec2<F> to_image(const Vec3<F>& d) const;
  template <class F>
  F density_at(Vec2<F> uv) const;
  template <class F>
  Vec2<LaneIndex<F>> cell_of(Vec2<F> uv) const;

  void build_density(const Layers& latlong, bool node_aligned);
  void store_density(int row, double row_share, const float* cumulative);

  LatLongTexels texels_;  ///< the fourth number is the density of the cell
  Size cells_;
  Vec2<float> scale_, offset_;         ///< (u, v) to texels of the bordered image
  double rotation_ = 0;                ///< [turn]
  int row_steps_ = 0;                  ///< halvings that find a row
  int column_steps_ = 0;               ///< and a column
  std::vector<float> rows_;            ///< [2^row_steps + 1] cumulative share of the rows
  int coarse_steps_ = 0;               ///< of the latter, those in the coarse table
  std::vector<float> columns_;         ///< [rows, 2^column_steps + 1] cumulative within each row
  std::vector<float> coarse_columns_;  ///< [rows, 2^coarse_steps] evenly taken from columns_
  std::vector<float> cosines_;         ///< [rows + 1] cosine of the polar angle at the rows' edges
};

template <class F>
Vec2<F> Environment::to_image(const Vec3<F>& d) const {
  const Vec2<F> uv = latlong_of(d);
  const F u = uv.x + F(static_cast<ScalarOf<F>>(rotation_));
  return {u - floor(u), uv.y};
}

template <class F>
Vec3<F> Environment::radiance_in_image(Vec2<F> uv) const {
  return texels_.bilinear(
      Vec2<F>{fma(uv.x, F(scale_.x), F(offset_.x)), fma(uv.y, F(scale_.y), F(offset_.y))});
}

template <class F>
Vec2<LaneIndex<F>> Environment::cell_of(Vec2<F> uv) const {
  const auto width = static_cast<float>(cells_.width), height = static_cast<float>(cells_.height);
  return {to_index<F>(clamp_to_table(uv.x * F(width), width - 1)),
          to_index<F>(clamp_to_table(uv.y * F(height), height - 1))};
}

template <class F>
Vec3<F> Environment::radiance(const Vec3<F>& d) const {
  return radiance_in_image(to_image(d));
}

template <class F>
F Environment::density_at(Vec2<F> uv) const {
  const Vec2<LaneIndex<F>> cell = cell_of(uv);
  return texels_.fourth<F>(cell.x + LaneIndex<F>(1), cell.y + LaneIndex<F>(1));
}

template <class F>
F Environment::density(const Vec3<F>& d) const {
  return density_at(to_image(d));
}

template <class F>
Arriving<F> Environment::arriving(const Vec3<F>& d) const {
  const Vec2<F> uv = to_image(d);
  return {radiance_in_image(uv), density_at(uv)};
}

// Moves `at` to the last of 2^steps ascending entries that is not above u, `low` to its value.
template <class F>
void Environment::descend(const float* cumulative, int steps, F u, LaneIndex<F>& at, F& low) {
  for (int stride = 1 << steps >> 1; stride > 0; stride >>= 1) {
    const LaneIndex<F> next = at + LaneIndex<F>(stride);
    const F value = table_at<F>(cumulative, next);
    const auto reached = value <= u;
    at = select_index<F>(reached, next, at);
    low = select(reached, value, low);
  }
}

// The entry after the one found is above u, so an interval is never empty.
template <class F>
Environment::Inverse<F> Environment::find_row(F u) const {
  LaneIndex<F> at(0);
  F low(0);
  descend(rows_.data(), row_steps_, u, at, low);
  const F high = table_at<F>(rows_.data() + 1, at);
  return {at, min((u - low) / (high - low), F(0x1.fffffep-1f))};
}

// Every so many-th entry first: these lie side by side and stay in the cache.
template <class F>
Environment::Inverse<F> Environment::find_column(LaneIndex<F> row, F u) const {
  const LaneIndex<F> first = row * LaneIndex<F>(1 << coarse_steps_);
  LaneIndex<F> coarse = first;
  F low(0);
  descend(coarse_columns_.data(), coarse_steps_, u, coarse, low);
  const int fine_steps = column_steps_ - coarse_steps_;
  const LaneIndex<F> start = row * LaneIndex<F>((1 << column_steps_) + 1);
  LaneIndex<F> at = start + (coarse - first) * LaneIndex<F>(1 << fine_steps);
  descend(columns_.data(), fine_steps, u, at, low);
  const F high = table_at<F>(columns_.data() + 1, at);
  return {at - start, min((u - low) / (high - low), F(0x1.fffffep-1f))};
}

template <class F>
LightSample<F> Environment::sample(Vec2<F> u) const {
  const F below_one = F(0x1.fffffep-1f);
  const F share = F(static_cast<float>(uniform_share));
  const F across = clamp(u.x, F(0), below_one);
  // The first share of u.y is stretched to draw from the whole sphere, the rest by importance.
  const auto uniform = u.y < share;
  const F down =
      clamp(select(uniform, u.y / share, (u.y - share) / (F(1) - share)), F(0), below_one);

  const Inverse<F> row = find_row(down);
  const Inverse<F> column = find_column(row.index, across);
  const F top = table_at<F>(cosines_.data(), row.index);
  const F bottom = table_at<F>(cosines_.data() + 1, row.index);

  const F inverse_width = F(1.0f / static_cast<float>(cells_.width));
  const F column_u = (from_index<F>(column.index) + column.offset) * inverse_width;
  const F image_u = select(uniform, across, column_u);
  const F cosine = select(uniform, fma(F(-2), down, F(1)), lerp(top, bottom, row.offset));
  const F sine = safe_sqrt(fma(-cosine, cosine, F(1)));
  const Vec2<F> uv{image_u, F(2) * turns_of(sine, cosine)};

  const auto azimuth = sine_cosine_of_turns(image_u - F(static_cast<ScalarOf<F>>(rotation_ + 0.5)));
  const Vec2<LaneIndex<F>> anywhere = cell_of(uv);
  const LaneIndex<F> one(1);
  const LaneIndex<F> x = select_index<F>(uniform, anywhere.x, column.index) + one;
  const LaneIndex<F> y = select_index<F>(uniform, anywhere.y, row.index) + one;
  return {{-azimuth.sine * sine, cosine, azimuth.cosine * sine},
          radiance_in_image(uv),
          texels_.fourth<F>(x, y)};
}

}  // namespace kiln

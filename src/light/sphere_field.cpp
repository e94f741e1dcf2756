// SPDX-License-Identifier: Apache-2.0
#include "sphere_field.h"

#include <algorithm>

#include "kiln/light/angles.h"

namespace kiln {
namespace {

constexpr int lanes = lane_count<WideDouble>;
constexpr size_t taps = 8;

/// Where directions lie on the grid, for as many as a wide number holds: the node left of each and
/// above it, and the weights of the nodes from 3 before to 4 after.
struct Stencils {
  double left[lanes], top[lanes];
  float across[lanes][taps], down[lanes][taps];
};

// Weights of the nodes -3 ... 4 at t in [0, 1), one column a direction.
void lagrange_weights(WideDouble t, float (&weights)[lanes][taps]) {
  // (-1)^(7 - i) / (i! (7 - i)!)
  constexpr std::array<double, taps> scale = {-1.0 / 5040, 1.0 / 720, -1.0 / 240, 1.0 / 144,
                                              -1.0 / 144,  1.0 / 240, -1.0 / 720, 1.0 / 5040};
  std::array<WideDouble, taps> above;
  above[taps - 1] = WideDouble(1.0);
  for (size_t i = taps - 1; i > 0; --i) {
    above[i - 1] = above[i] * (t + WideDouble(3.0 - static_cast<double>(i)));
  }
  WideDouble below(1.0);
  for (size_t i = 0; i < taps; ++i) {
    double values[lanes];
    store_lanes(values, WideDouble(scale[i]) * below * above[i]);
    for (int lane = 0; lane < lanes; ++lane) weights[lane][i] = static_cast<float>(values[lane]);
    below = below * (t + WideDouble(3.0 - static_cast<double>(i)));
  }
}

Stencils place(std::span<const Vec3<double>> directions, int height) {
  double x[lanes], y[lanes], z[lanes];
  for (size_t i = 0; i < lanes; ++i) {
    const Vec3<double>& d = directions[std::min(i, directions.size() - 1)];
    x[i] = d.x;
    y[i] = d.y;
    z[i] = d.z;
  }
  const Vec2<WideDouble> uv = latlong_of(Vec3<WideDouble>{
      load_lanes<WideDouble>(x), load_lanes<WideDouble>(y), load_lanes<WideDouble>(z)});
  const auto coordinate = [](WideDouble u, double count) {
    return clamp(fma(u, WideDouble(count), WideDouble(-0.5)), WideDouble(-0.5),
                 WideDouble(count - 0.5));
  };
  const WideDouble across = coordinate(uv.x, 2.0 * height), down = coordinate(uv.y, height);
  const WideDouble left = floor(across), top = floor(down);
  Stencils stencils;
  store_lanes(stencils.left, left);
  store_lanes(stencils.top, top);
  lagrange_weights(across - left, stencils.across);
  lagrange_weights(down - top, stencils.down);
  return stencils;
}

}  // namespace

SphereField::SphereField(int height)
    : height_(height),
      values_(static_cast<size_t>(height + 2 * border) *
              static_cast<size_t>(2 * height + 2 * border) * 4) {}

void SphereField::fill_border() {
  const auto copy = [this](int from_x, int from_y, int x, int y) {
    std::copy_n(texel(from_x, from_y), 4, texel(x, y));
  };
  const int half_turn = height_;
  for (int i = 0; i < border; ++i) {
    for (int x = 0; x < width(); ++x) {
      const int across = (x + half_turn) % width();
      copy(across, i, x, -1 - i);
      copy(across, height_ - 1 - i, x, height_ + i);
    }
  }
  for (int y = -border; y < height_ + border; ++y) {
    for (int i = 0; i < border; ++i) {
      copy(width() - 1 - i, y, -1 - i, y);
      copy(i, y, width() + i, y);
    }
  }
}

// Two nodes to a wide number.
std::array<float, 4> SphereField::interpolated(size_t corner, const float* across,
                                               const float* down) const {
  static_assert(lane_count<WideFloat> == 8);
  const size_t row_length = static_cast<size_t>(width() + 2 * border) * 4;
  std::array<WideFloat, taps / 2> weights;
  for (size_t i = 0; i < weights.size(); ++i) {
    const float a = across[2 * i], b = across[2 * i + 1];
    const float both[8] = {a, a, a, a, b, b, b, b};
    weights[i] = load_lanes<WideFloat>(both);
  }
  WideFloat sum(0.0f);
  for (size_t j = 0; j < taps; ++j) {
    const float* row = values_.data() + corner + j * row_length;
    WideFloat along(0.0f);
    for (size_t i = 0; i < weights.size(); ++i) {
      along = fma(weights[i], load_lanes<WideFloat>(row + 8 * i), along);
    }
    sum = fma(WideFloat(down[j]), along, sum);
  }
  float both[8];
  store_lanes(both, sum);
  return {both[0] + both[4], both[1] + both[5], both[2] + both[6], both[3] + both[7]};
}

void SphereField::evaluate(std::span<const Vec3<double>> directions,
                           std::span<std::array<float, 4>> values) const {
  for (size_t i = 0; i < directions.size(); i += lanes) {
    const size_t count = std::min<size_t>(lanes, directions.size() - i);
    const Stencils stencils = place(directions.subspan(i, count), height_);
    for (size_t k = 0; k < count; ++k) {
      const size_t corner =
          index_of(static_cast<int>(stencils.left[k]) - 3, static_cast<int>(stencils.top[k]) - 3);
      values[i + k] = interpolated(corner, stencils.across[k], stencils.down[k]);
    }
  }
}

}  // namespace kiln

// SPDX-License-Identifier: Apache-2.0
#include "sphere_field.h"

#include <algorithm>

#include "kiln/image/projection.h"

namespace kiln {
namespace {

constexpr int taps = 8;

/// Weights of the nodes -3 ... 4 at t in [0, 1).
std::array<float, taps> lagrange_weights(double t) {
  // (-1)^(7 - i) / (i! (7 - i)!)
  constexpr std::array<double, taps> scale = {-1.0 / 5040, 1.0 / 720, -1.0 / 240, 1.0 / 144,
                                              -1.0 / 144,  1.0 / 240, -1.0 / 720, 1.0 / 5040};
  std::array<double, taps + 1> below{1}, above{1};
  for (size_t i = 0; i < taps; ++i) {
    below[i + 1] = below[i] * (t + 3 - static_cast<double>(i));
    above[i + 1] = above[i] * (t - 4 + static_cast<double>(i));
  }
  std::array<float, taps> weights;
  for (size_t i = 0; i < taps; ++i) {
    weights[i] = static_cast<float>(scale[i] * below[i] * above[taps - 1 - i]);
  }
  return weights;
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

std::array<float, 4> SphereField::at(const Vec3<double>& d) const {
  const Vec2<double> uv = direction_to_latlong(d);
  const double x = std::clamp(uv.x * width() - 0.5, -0.5, width() - 0.5);
  const double y = std::clamp(uv.y * height_ - 0.5, -0.5, height_ - 0.5);
  const double left = std::floor(x), top = std::floor(y);
  const auto across = lagrange_weights(x - left), down = lagrange_weights(y - top);
  const float* corner =
      values_.data() + index_of(static_cast<int>(left) - 3, static_cast<int>(top) - 3);
  const size_t row_length = static_cast<size_t>(width() + 2 * border) * 4;
  std::array<float, 4> result{};
  for (size_t j = 0; j < taps; ++j) {
    const float* row = corner + j * row_length;
    std::array<float, 4> sum{};
    for (size_t i = 0; i < taps; ++i) {
      for (size_t c = 0; c < 4; ++c) sum[c] += across[i] * row[4 * i + c];
    }
    for (size_t c = 0; c < 4; ++c) result[c] += down[j] * sum[c];
  }
  return result;
}

}  // namespace kiln

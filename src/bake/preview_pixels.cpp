// SPDX-License-Identifier: Apache-2.0
#include "preview_pixels.h"

#include <algorithm>

namespace kiln {
namespace {

using F = WideFloat;
constexpr int lanes = lane_count<F>;

}  // namespace

Estimate summarise(const std::array<Vec3<F>, repetitions>& means) {
  Vec3<F> mean{F(0), F(0), F(0)}, squares{F(0), F(0), F(0)};
  for (const Vec3<F>& one : means) mean += one;
  mean = mean * F(1.0f / repetitions);
  for (const Vec3<F>& one : means) {
    const Vec3<F> d = one - mean;
    squares += d * d;
  }
  const F scale(1.0f / (repetitions * (repetitions - 1)));
  return {mean, {sqrt(squares.x * scale), sqrt(squares.y * scale), sqrt(squares.z * scale)}};
}

WideUint texel_hashes(int x, int y, int seed) {
  std::uint32_t hashes[lanes];
  for (int lane = 0; lane < lanes; ++lane) {
    const auto row = combine_hash<std::uint32_t>(static_cast<std::uint32_t>(seed),
                                                 static_cast<std::uint32_t>(y));
    hashes[lane] = combine_hash<std::uint32_t>(row, static_cast<std::uint32_t>(x + lane));
  }
  return WideUint::load_unaligned(hashes);
}

void store_color(Layers& image, int first_plane, int x, int y, const Vec3<F>& color) {
  store_lanes(image.layers[first_plane].plane.row(y) + x, color.x);
  store_lanes(image.layers[first_plane + 1].plane.row(y) + x, color.y);
  store_lanes(image.layers[first_plane + 2].plane.row(y) + x, color.z);
}

void fill_coverage(const Picture& picture, Layers& image) {
  Plane& alpha = image.layers[3].plane;
  if (!picture.is_ball()) {
    alpha = Plane(picture.size(), 1);
    return;
  }
  for (int y = 0; y < picture.size().height; ++y) {
    for (int x = 0; x < picture.size().width; ++x) alpha.at(x, y) = picture.coverage(x, y);
  }
}

bool covers_any(const Layers& image, int x, int y) {
  const float* alpha = image.layers[3].plane.row(y) + x;
  return std::any_of(alpha, alpha + lanes, [](float a) { return a > 0; });
}

void scale_plane(Plane& plane, float scale) {
  for (int y = 0; y < plane.height(); ++y) {
    float* row = plane.row(y);
    for (int x = 0; x < plane.width(); ++x) row[x] *= scale;
  }
}

void clear_background(const Picture& picture, Layers& image) {
  if (!picture.is_ball()) return;
  const Plane& alpha = image.layers[3].plane;
  for (size_t l = 0; l < image.layers.size(); ++l) {
    if (l == 3) continue;
    for (int y = 0; y < image.size.height; ++y) {
      float* row = image.layers[l].plane.row(y);
      for (int x = 0; x < image.size.width; ++x) row[x] = alpha.at(x, y) > 0 ? row[x] : 0;
    }
  }
}

}  // namespace kiln

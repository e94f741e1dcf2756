// SPDX-License-Identifier: Apache-2.0
#include "kiln/validate/error_picture.h"

#include <algorithm>
#include <cmath>

namespace kiln {
namespace {

constexpr int least_width = 256;  // of one channel [texel]
constexpr int gap = 8;            // between channels [texel]

float greatest_of(const Layers& errors) {
  float greatest = 0;
  for (const Layer& layer : errors.layers) {
    for (int y = 0; y < errors.size.height; ++y) {
      for (const float error : layer.plane.texels_of_row(y)) {
        greatest = std::max(greatest, std::abs(error));
      }
    }
  }
  return greatest;
}

// Square root, so that errors a hundred times smaller than the greatest still show.
void paint(Layers& picture, int x, int y, float share) {
  const float depth = std::sqrt(std::min(std::abs(share), 1.0f));
  const float faded = 1 - depth;
  picture.layers[0].plane.at(x, y) = share >= 0 ? 1 : faded;
  picture.layers[1].plane.at(x, y) = faded;
  picture.layers[2].plane.at(x, y) = share <= 0 ? 1 : faded;
}

}  // namespace

Layers error_picture(const Verdict& verdict) {
  const Layers& errors = verdict.errors;
  const int count = static_cast<int>(errors.layers.size());
  const int zoom = std::max(1, least_width / std::max(errors.size.width, 1));
  const int width = errors.size.width * zoom, height = errors.size.height * zoom;
  Layers picture = make_layers({count * width + (count - 1) * gap, height}, {"R", "G", "B"});
  const float greatest = std::max(greatest_of(errors), 1e-30f);
  for (int c = 0; c < count; ++c) {
    const Plane& plane = errors.layers[c].plane;
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        paint(picture, c * (width + gap) + x, y, plane.at(x / zoom, y / zoom) / greatest);
      }
    }
  }
  return picture;
}

}  // namespace kiln

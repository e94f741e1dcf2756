// SPDX-License-Identifier: Apache-2.0
#include "kiln/image/resample.h"

#include <algorithm>
#include <cmath>

#include "kiln/parallel/rows.h"

namespace kiln {
namespace {

// The input texels that one output texel sees along one axis, and their weights (sum 1).
struct Taps {
  int first = 0;
  std::vector<float> weights;
};

// Area average: the output texel covers [i, i+1) * in/out of the input.
Taps area_taps(int i, int in, int out) {
  const double begin = static_cast<double>(i) * in / out;
  const double end = static_cast<double>(i + 1) * in / out;
  const int first = static_cast<int>(begin);
  const int last = std::min(in - 1, static_cast<int>(std::ceil(end)) - 1);
  Taps taps{first, {}};
  for (int x = first; x <= last; ++x) {
    const double covered = std::min<double>(end, x + 1) - std::max<double>(begin, x);
    taps.weights.push_back(static_cast<float>(covered / (end - begin)));
  }
  return taps;
}

Taps bilinear_taps(int i, int in, int out) {
  const double centre = (i + 0.5) * in / out - 0.5;
  const int left = static_cast<int>(std::floor(centre));
  const auto t = static_cast<float>(centre - left);
  if (left < 0) return {0, {1.0f}};
  if (left >= in - 1) return {in - 1, {1.0f}};
  return {left, {1.0f - t, t}};
}

std::vector<Taps> taps_of_axis(int in, int out) {
  std::vector<Taps> taps;
  taps.reserve(static_cast<size_t>(out));
  for (int i = 0; i < out; ++i) {
    taps.push_back(out <= in ? area_taps(i, in, out) : bilinear_taps(i, in, out));
  }
  return taps;
}

}  // namespace

Plane resample(const Plane& plane, Size size) {
  if (plane.size() == size) return plane;
  const auto across = taps_of_axis(plane.width(), size.width);
  const auto down = taps_of_axis(plane.height(), size.height);
  Plane narrow({size.width, plane.height()});
  for_rows(plane.height(), [&](int y) {
    const float* from = plane.row(y);
    for (int x = 0; x < size.width; ++x) {
      float sum = 0;
      const Taps& taps = across[x];
      for (size_t k = 0; k < taps.weights.size(); ++k)
        sum += taps.weights[k] * from[taps.first + k];
      narrow.at(x, y) = sum;
    }
  });
  Plane result(size);
  for_rows(size.height, [&](int y) {
    const Taps& taps = down[y];
    float* to = result.row(y);
    for (size_t k = 0; k < taps.weights.size(); ++k) {
      const float* from = narrow.row(taps.first + static_cast<int>(k));
      for (int x = 0; x < size.width; ++x) to[x] += taps.weights[k] * from[x];
    }
  });
  return result;
}

Layers resample(const Layers& image, Size size) {
  Layers result{size, {}};
  for (const Layer& layer : image.layers) {
    result.layers.push_back({layer.name, resample(layer.plane, size)});
  }
  return result;
}

Plane halve(const Plane& plane) {
  return resample(plane,
                  {std::max(1, (plane.width() + 1) / 2), std::max(1, (plane.height() + 1) / 2)});
}

}  // namespace kiln

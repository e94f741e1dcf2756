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

Taps taps_at(int i, int in, int out) {
  return out <= in ? area_taps(i, in, out) : bilinear_taps(i, in, out);
}

std::vector<Taps> taps_of_axis(int in, int out) {
  std::vector<Taps> taps;
  taps.reserve(static_cast<size_t>(out));
  for (int i = 0; i < out; ++i) {
    taps.push_back(taps_at(i, in, out));
  }
  return taps;
}

}  // namespace

RowRange rows_read(int in, int out, RowRange rows) {
  if (in == out) return rows;
  const Taps top = taps_at(rows.first, in, out),
             bottom = taps_at(rows.first + rows.count - 1, in, out);
  return {top.first, bottom.first + static_cast<int>(bottom.weights.size()) - top.first};
}

Plane resample_rows(const Plane& window, int window_first, int height, Size size, RowRange rows) {
  const auto across = taps_of_axis(window.width(), size.width);
  Plane narrow({size.width, window.height()});
  for_rows(window.height(), [&](int y) {
    const float* from = window.row(y);
    for (int x = 0; x < size.width; ++x) {
      float sum = 0;
      const Taps& taps = across[x];
      for (size_t k = 0; k < taps.weights.size(); ++k)
        sum += taps.weights[k] * from[taps.first + k];
      narrow.at(x, y) = sum;
    }
  });
  Plane result({size.width, rows.count});
  for_rows(rows.count, [&](int y) {
    const Taps taps = taps_at(rows.first + y, height, size.height);
    float* to = result.row(y);
    for (size_t k = 0; k < taps.weights.size(); ++k) {
      const float* from = narrow.row(taps.first + static_cast<int>(k) - window_first);
      for (int x = 0; x < size.width; ++x) to[x] += taps.weights[k] * from[x];
    }
  });
  return result;
}

Plane resample(const Plane& plane, Size size) {
  if (plane.size() == size) return plane;
  return resample_rows(plane, 0, plane.height(), size, {0, size.height});
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

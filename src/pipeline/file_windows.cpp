// SPDX-License-Identifier: Apache-2.0
#include "file_windows.h"

#include <algorithm>
#include <utility>

namespace kiln {
namespace {

Layers last_rows(const Layers& image, int count) {
  const int first = std::max(0, image.size.height - count);
  Layers rows{{image.size.width, image.size.height - first}, {}};
  for (const Layer& layer : image.layers) {
    Plane& plane = rows.add(layer.name);
    for (int y = first; y < image.size.height; ++y) {
      const auto row = layer.plane.texels_of_row(y);
      std::copy(row.begin(), row.end(), plane.row(y - first));
    }
  }
  return rows;
}

void put_above(const Layers& above, int from, Layers& image) {
  const int rows = above.size.height - from;
  Layers both{{image.size.width, image.size.height + rows}, {}};
  for (size_t c = 0; c < image.layers.size(); ++c) {
    Plane& plane = both.add(image.layers[c].name);
    for (int y = 0; y < both.size.height; ++y) {
      const auto row = y < rows ? above.layers[c].plane.texels_of_row(from + y)
                                : image.layers[c].plane.texels_of_row(y - rows);
      std::copy(row.begin(), row.end(), plane.row(y));
    }
  }
  image = std::move(both);
}

}  // namespace

MapRows::Window FileWindows::next(int height, RowRange rows) {
  constexpr int most_shared = 2;  // rows that windows side by side have in common
  const int own_height = facts().size.height;
  const RowRange needed = rows_read(own_height, height, rows);
  if (needed.first > next_) rows_.next(needed.first - next_);
  const int first = std::max(needed.first, next_);
  MapRows::Window window{needed.first, rows_.next(needed.first + needed.count - first)};
  if (needed.first < next_) {
    put_above(tail_, tail_.size.height - (next_ - needed.first), window.image);
  }
  next_ = needed.first + needed.count;
  if (own_height != height) tail_ = last_rows(window.image, most_shared);
  return window;
}

}  // namespace kiln

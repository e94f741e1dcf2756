// SPDX-License-Identifier: Apache-2.0
#include "orientation.h"

#include <fmt/format.h>

#include <utility>

namespace kiln::io {
namespace {

// Stored row 0 is the edge: 1, 2 top; 3, 4 bottom; 5, 8 left; 6, 7 right of the upright image.
// Stored column 0 is the edge: 1, 4 left; 2, 3 right; 5, 6 top; 7, 8 bottom.
bool rows_are_columns(int orientation) { return orientation >= 5; }
bool row_from_far_edge(int o) { return o == 3 || o == 4 || o == 6 || o == 7; }
bool column_from_far_edge(int o) { return o == 2 || o == 3 || o == 7 || o == 8; }

Plane turned(const Plane& stored, int orientation) {
  Plane upright(oriented(stored.size(), orientation));
  for (int y = 0; y < stored.height(); ++y) {
    const int row = row_from_far_edge(orientation) ? stored.height() - 1 - y : y;
    for (int x = 0; x < stored.width(); ++x) {
      const int column = column_from_far_edge(orientation) ? stored.width() - 1 - x : x;
      float& texel =
          rows_are_columns(orientation) ? upright.at(row, column) : upright.at(column, row);
      texel = stored.at(x, y);
    }
  }
  return upright;
}

}  // namespace

Size oriented(Size stored, int orientation) {
  return rows_are_columns(orientation) ? Size{stored.height, stored.width} : stored;
}

Layers oriented(Layers stored, int orientation) {
  if (orientation == 1) return stored;
  Layers upright{oriented(stored.size, orientation), {}};
  for (Layer& layer : stored.layers) {
    upright.layers.push_back({std::move(layer.name), turned(layer.plane, orientation)});
    layer.plane = Plane();
  }
  return upright;
}

void note_orientation(int orientation, FileFacts& facts) {
  if (orientation == 1) return;
  facts.notes.push_back(
      fmt::format("orientation {} in the file; the image was turned upright", orientation));
}

}  // namespace kiln::io

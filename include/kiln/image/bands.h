// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "kiln/image/layers.h"

namespace kiln {

/// An image that is made a band of rows at a time and never held whole.
struct ImageBands {
  Size size;                       ///< of the whole
  std::vector<std::string> names;  ///< of its layers
  int band_rows = 0;               ///< of each band; the last may have fewer
  /// Rows [first, first + rows) as layers of those names. Bands are asked for from the top, each
  /// once and one at a time.
  std::function<Layers(int first, int rows)> make;
};

}  // namespace kiln

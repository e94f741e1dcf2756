// SPDX-License-Identifier: Apache-2.0
#include "kiln/light/latlong_texels.h"

#include <limits>

#include "color_planes.h"
#include "kiln/core/error.h"
#include "kiln/parallel/rows.h"

namespace kiln {

LatLongTexels::LatLongTexels(const Layers& image, int columns, Pole pole)
    : size_{columns, image.size.height}, stride_(columns + 2) {
  const int height = size_.height;
  if (4LL * stride_ * (height + 2) > std::numeric_limits<std::int32_t>::max()) {
    throw Error(Fault::Input, "the environment image is " + std::to_string(image.size.width) + "x" +
                                  std::to_string(image.size.height) +
                                  ", expected at most 5e8 texels");
  }
  texels_.resize(static_cast<size_t>(stride_) * static_cast<size_t>(height + 2) * 4);
  for_rows(height, [&](int y) { fill_row(image, y, y + 1, 0); });
  const int turn = pole == Pole::AcrossByHalfATurn ? columns / 2 : 0;
  fill_row(image, 0, 0, turn);
  fill_row(image, height - 1, height + 1, turn);
}

void LatLongTexels::set_fourth(int x, int y, float value) {
  texels_[(static_cast<size_t>(y) * static_cast<size_t>(stride_) + static_cast<size_t>(x)) * 4 +
          3] = value;
}

// Image row `from`, shifted by `turn` texels, as row `to` of the bordered image.
void LatLongTexels::fill_row(const Layers& image, int from, int to, int turn) {
  const ColorPlanes colors = color_planes(image);
  float* row = texels_.data() + static_cast<size_t>(to) * static_cast<size_t>(stride_) * 4;
  for (int x = 0; x < stride_; ++x) {
    const int column = (x - 1 + turn + size_.width) % size_.width;
    for (size_t c = 0; c < 3; ++c) {
      row[static_cast<size_t>(x) * 4 + c] = colors.planes[c]->at(column, from);
    }
  }
}

}  // namespace kiln

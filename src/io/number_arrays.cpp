// SPDX-License-Identifier: Apache-2.0
#include "kiln/io/number_arrays.h"

#include <fmt/format.h>

#include "kiln/core/error.h"

namespace kiln {

std::vector<NumberArray> read_arrays(const std::filesystem::path& path, const ReadLimits& limits) {
  const ImageFile file = read_image(path, limits);
  NumberArray array;
  array.shape = {file.image.size.height, file.image.size.width,
                 static_cast<int>(file.image.layers.size())};
  array.channels = file.facts.channels;
  array.attributes = file.facts.attributes;
  array.notes = file.facts.notes;
  for (int y = 0; y < file.image.size.height; ++y) {
    for (int x = 0; x < file.image.size.width; ++x) {
      for (const Layer& layer : file.image.layers) array.values.push_back(layer.plane.at(x, y));
    }
  }
  return {array};
}

}  // namespace kiln

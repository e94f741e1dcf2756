// SPDX-License-Identifier: Apache-2.0
#include "kiln/image/layers.h"

#include <cmath>

namespace kiln {

const Plane* Layers::find(const std::string& name) const {
  for (const Layer& layer : layers) {
    if (layer.name == name) return &layer.plane;
  }
  return nullptr;
}

Plane& Layers::add(const std::string& name, float value) {
  layers.push_back({name, Plane(size, value)});
  return layers.back().plane;
}

Layers make_layers(Size size, const std::vector<std::string>& names) {
  Layers image{size, {}};
  for (const std::string& name : names) image.add(name);
  return image;
}

Oddities count_oddities(const Layers& image) {
  Oddities found;
  for (const Layer& layer : image.layers) {
    for (int y = 0; y < image.size.height; ++y) {
      for (float value : layer.plane.texels_of_row(y)) {
        found.nan += std::isnan(value);
        found.inf += std::isinf(value);
        found.negative += value < 0;
      }
    }
  }
  return found;
}

}  // namespace kiln

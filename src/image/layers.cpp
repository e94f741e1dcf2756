// SPDX-License-Identifier: Apache-2.0
#include "kiln/image/layers.h"

#include <algorithm>
#include <cmath>

#include "kiln/parallel/rows.h"

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
  const auto found = sum_rows(image.size.height, 3, [&](int y, std::vector<double>& row) {
    int nan = 0, inf = 0, negative = 0;
    for (const Layer& layer : image.layers) {
      for (float value : layer.plane.texels_of_row(y)) {
        nan += std::isnan(value);
        inf += std::isinf(value);
        negative += value < 0;
      }
    }
    row = {double(nan), double(inf), double(negative)};
  });
  const auto whole = [](double count) { return static_cast<long long>(count); };
  return {whole(found[0]), whole(found[1]), whole(found[2])};
}

std::optional<TexelPlace> first_not_finite(const Layers& image) {
  for (const Layer& layer : image.layers) {
    for (int y = 0; y < image.size.height; ++y) {
      const auto row = layer.plane.texels_of_row(y);
      const auto odd =
          std::find_if(row.begin(), row.end(), [](float v) { return !std::isfinite(v); });
      if (odd != row.end()) return TexelPlace{layer.name, static_cast<int>(odd - row.begin()), y};
    }
  }
  return std::nullopt;
}

}  // namespace kiln

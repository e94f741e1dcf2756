// SPDX-License-Identifier: Apache-2.0
#include "stored_planes.h"

#include <algorithm>
#include <numeric>

#include "samples.h"

namespace kiln::io {

StoredPlanes in_file_order(const Layers& image, const std::vector<std::string>& labels) {
  std::vector<size_t> order(image.layers.size());
  std::iota(order.begin(), order.end(), size_t{0});
  const auto rank = [&](size_t at) { return channel_rank(image.layers[at].name); };
  const bool all_known = std::all_of(order.begin(), order.end(),
                                     [&](size_t at) { return rank(at) <= channel_rank("A"); });
  if (all_known) {
    std::stable_sort(order.begin(), order.end(),
                     [&](size_t a, size_t b) { return rank(a) < rank(b); });
  }
  const bool labelled = labels.size() == order.size();
  StoredPlanes stored;
  stored.planes.reserve(order.size());
  stored.names.reserve(order.size());
  for (const size_t at : order) {
    const Layer& layer = image.layers[at];
    if (layer.name == "A") stored.alpha_channel = static_cast<int>(stored.planes.size());
    stored.planes.push_back(&layer.plane);
    stored.names.push_back(labelled ? labels[at] : layer.name);
  }
  return stored;
}

StoredPlanes planes_of(const Layers& image) {
  StoredPlanes stored;
  for (const Layer& layer : image.layers) {
    stored.planes.push_back(&layer.plane);
    stored.names.push_back(layer.name);
  }
  if (stored.planes.size() == 4) stored.alpha_channel = 3;
  return stored;
}

}  // namespace kiln::io

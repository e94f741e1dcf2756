// SPDX-License-Identifier: Apache-2.0
#include "kiln/image/compare.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "kiln/core/error.h"

namespace kiln {

Difference compare(const Layers& a, const Layers& b) {
  if (a.size != b.size) {
    throw Error(Fault::Input, fmt::format("images differ in size: {}x{} and {}x{}", a.size.width,
                                          a.size.height, b.size.width, b.size.height));
  }
  std::vector<double> errors;
  for (const Layer& layer : a.layers) {
    const Plane* other = b.find(layer.name);
    if (!other)
      throw Error(Fault::Input, fmt::format("channel '{}' is in one image only", layer.name));
    for (int y = 0; y < a.size.height; ++y) {
      for (int x = 0; x < a.size.width; ++x) {
        errors.push_back(std::abs(static_cast<double>(layer.plane.at(x, y)) - other->at(x, y)));
      }
    }
  }
  if (errors.empty()) return {};
  Difference result;
  for (double error : errors) {
    result.mean += error;
    result.rms += error * error;
    result.max = std::max(result.max, error);
  }
  result.mean /= static_cast<double>(errors.size());
  result.rms = std::sqrt(result.rms / static_cast<double>(errors.size()));
  const auto rank = errors.begin() + static_cast<std::ptrdiff_t>(0.95 * (errors.size() - 1));
  std::nth_element(errors.begin(), rank, errors.end());
  result.percentile_95 = *rank;
  return result;
}

}  // namespace kiln

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <compare>

namespace kiln {

/// Extent of an image [texel].
struct Size {
  int width = 0;
  int height = 0;
  auto operator<=>(const Size&) const = default;
};

inline long long area(Size size) { return static_cast<long long>(size.width) * size.height; }

}  // namespace kiln

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "kiln/image/plane.h"

namespace kiln {

struct Layer {
  std::string name;  ///< channel name: "R", "G", "B", "A", "stderr.R", ...
  Plane plane;
};

/// An image: named planes of one size, linear float, alpha unassociated.
struct Layers {
  Size size;
  std::vector<Layer> layers;

  /// The plane of that name, or nullptr.
  const Plane* find(const std::string& name) const;
  Plane& add(const std::string& name, float value = 0.0f);
};

/// A new image with planes of these names.
Layers make_layers(Size size, const std::vector<std::string>& names);

/// Texels that are not finite, or below zero, per image.
struct Oddities {
  long long nan = 0;
  long long inf = 0;
  long long negative = 0;
};
Oddities count_oddities(const Layers& image);

/// A texel of one channel.
struct TexelPlace {
  std::string channel;
  int x = 0, y = 0;
};

/// The first texel that is not finite, channel by channel, row by row.
std::optional<TexelPlace> first_not_finite(const Layers& image);

}  // namespace kiln

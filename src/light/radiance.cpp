// SPDX-License-Identifier: Apache-2.0
#include "kiln/light/radiance.h"

#include <cmath>
#include <optional>

#include "kiln/core/error.h"
#include "kiln/parallel/rows.h"

namespace kiln {
namespace {

/// Sum and count of finite values.
struct Finite {
  double sum = 0;
  int count = 0;

  void add(float value) {
    if (!std::isfinite(value)) return;
    sum += value;
    ++count;
  }
};

// The texels at distance `radius` in the larger of the two axes. Once the ring meets itself behind
// the image, its sides lie on columns already seen, which does no harm.
Finite finite_on_ring(const Plane& plane, int x, int y, int radius) {
  Finite found;
  const auto add = [&](int column, int row) {
    if (row < 0 || row >= plane.height()) return;
    const int width = plane.width();
    found.add(plane.at(((column % width) + width) % width, row));
  };
  for (int i = -radius; i <= radius; ++i) {
    add(x + i, y - radius);
    add(x + i, y + radius);
  }
  for (int i = 1 - radius; i < radius; ++i) {
    add(x - radius, y + i);
    add(x + radius, y + i);
  }
  return found;
}

float mean_of_neighbours(const Plane& plane, int x, int y) {
  const int farthest = std::max(plane.width(), plane.height());
  for (int radius = 1; radius <= farthest; ++radius) {
    const Finite ring = finite_on_ring(plane, x, y, radius);
    if (ring.count > 0) return static_cast<float>(ring.sum / ring.count);
  }
  return 0;
}

bool has_finite(const Plane& plane) {
  for (int y = 0; y < plane.height(); ++y) {
    for (float value : plane.texels_of_row(y)) {
      if (std::isfinite(value)) return true;
    }
  }
  return false;
}

void replace(Plane& plane, Fix fix) {
  const Plane found = plane;
  const bool zero = fix == Fix::Zero || !has_finite(found);
  for_rows(plane.height(), [&](int y) {
    for (int x = 0; x < plane.width(); ++x) {
      if (std::isfinite(found.at(x, y))) continue;
      plane.at(x, y) = zero ? 0.0f : mean_of_neighbours(found, x, y);
    }
  });
}

Layers with_size(const Layers& image, Size size) {
  Layers result{size, {}};
  for (const Layer& layer : image.layers) result.add(layer.name);
  return result;
}

}  // namespace

Fixed fix_radiance(Layers& latlong, Fix fix) {
  const Oddities found = count_oddities(latlong);
  if (fix != Fix::None && found.nan + found.inf > 0) {
    for (Layer& layer : latlong.layers) replace(layer.plane, fix);
  }
  return {found.nan, found.inf, found.negative};
}

Layers texel_centred(const Layers& node_aligned) {
  const Size size{node_aligned.size.width - 1, node_aligned.size.height - 1};
  if (size.width < 1 || size.height < 1) {
    throw Error(Fault::Input, "a node-aligned environment needs at least 2x2 texels, found " +
                                  std::to_string(size.width + 1) + "x" +
                                  std::to_string(size.height + 1));
  }
  Layers result = with_size(node_aligned, size);
  for (size_t i = 0; i < result.layers.size(); ++i) {
    const Plane& from = node_aligned.layers[i].plane;
    Plane& to = result.layers[i].plane;
    for_rows(size.height, [&](int y) {
      for (int x = 0; x < size.width; ++x) {
        to.at(x, y) = 0.25f * ((from.at(x, y) + from.at(x + 1, y)) +
                               (from.at(x, y + 1) + from.at(x + 1, y + 1)));
      }
    });
  }
  return result;
}

}  // namespace kiln

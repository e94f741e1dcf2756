// SPDX-License-Identifier: Apache-2.0
#include "kiln/light/radiance.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

#include "kiln/core/error.h"
#include "kiln/parallel/rows.h"

namespace kiln {
namespace {

/// Which texels of a plane are not finite; one bit each.
class NotFinite {
 public:
  explicit NotFinite(const Plane& plane)
      : words_(static_cast<size_t>((plane.width() + 63) / 64)),
        bits_(words_ * static_cast<size_t>(plane.height())) {
    for_rows(plane.height(), [&](int y) {
      for (int x = 0; x < plane.width(); ++x) {
        if (!std::isfinite(plane.at(x, y))) word(x, y) |= bit(x);
      }
    });
  }

  bool at(int x, int y) const { return (bits_[index(x, y)] & bit(x)) != 0; }
  bool everywhere(const Plane& plane) const {
    long long count = 0;
    for (const std::uint64_t bits : bits_) count += std::popcount(bits);
    return count == area(plane.size());
  }

 private:
  static std::uint64_t bit(int x) { return std::uint64_t{1} << (x % 64); }
  size_t index(int x, int y) const {
    return static_cast<size_t>(y) * words_ + static_cast<size_t>(x / 64);
  }
  std::uint64_t& word(int x, int y) { return bits_[index(x, y)]; }

  size_t words_;
  std::vector<std::uint64_t> bits_;
};

/// A plane whose texels that are not finite are being replaced, in place: only the others are read.
struct Repair {
  const Plane& plane;
  const NotFinite& not_finite;
  Edges edges;
};

/// Sum and count of finite values.
struct Finite {
  double sum = 0;
  int count = 0;
};

// The texels at distance `radius` in the larger of the two axes. Once the ring meets itself behind
// the image, its sides lie on columns already seen, which does no harm.
Finite finite_on_ring(const Repair& repair, int x, int y, int radius) {
  Finite found;
  const int width = repair.plane.width(), height = repair.plane.height();
  const auto add = [&](int column, int row) {
    if (row < 0 || row >= height) return;
    if (repair.edges == Edges::Around) column = ((column % width) + width) % width;
    if (column < 0 || column >= width || repair.not_finite.at(column, row)) return;
    found.sum += repair.plane.at(column, row);
    ++found.count;
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

float mean_of_neighbours(const Repair& repair, int x, int y) {
  const int farthest = std::max(repair.plane.width(), repair.plane.height());
  for (int radius = 1; radius <= farthest; ++radius) {
    const Finite ring = finite_on_ring(repair, x, y, radius);
    if (ring.count > 0) return static_cast<float>(ring.sum / ring.count);
  }
  return 0;
}

void replace(Plane& plane, Fix fix, Edges edges) {
  const NotFinite not_finite(plane);
  const bool zero = fix == Fix::Zero || not_finite.everywhere(plane);
  const Repair repair{plane, not_finite, edges};
  for_rows(plane.height(), [&](int y) {
    for (int x = 0; x < plane.width(); ++x) {
      if (!not_finite.at(x, y)) continue;
      plane.at(x, y) = zero ? 0.0f : mean_of_neighbours(repair, x, y);
    }
  });
}

Layers with_size(const Layers& image, Size size) {
  Layers result{size, {}};
  for (const Layer& layer : image.layers) result.add(layer.name);
  return result;
}

}  // namespace

Fixed fix_radiance(Layers& image, Fix fix, Edges edges) {
  const Oddities found = count_oddities(image);
  Fixed fixed{found.nan, found.inf, found.negative, {}};
  if (found.nan + found.inf == 0) return fixed;
  fixed.first = first_not_finite(image);
  if (fix == Fix::None) return fixed;
  for (Layer& layer : image.layers) replace(layer.plane, fix, edges);
  return fixed;
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

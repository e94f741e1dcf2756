// SPDX-License-Identifier: Apache-2.0
#include "kiln/light/specular_chain.h"

#include "kiln/core/error.h"
#include "kiln/light/chain_plan.h"
#include "kiln/light/prefilter.h"
#include "kiln/parallel/rows.h"

namespace kiln {
namespace {

// More would not fit 32-bit indices.
constexpr int largest_face = 4096;

void check_size(int size) {
  if (size >= 1 && size <= largest_face) return;
  throw Error(Fault::Usage, "faces of " + std::to_string(size) +
                                " texels asked for, expected 1 to " + std::to_string(largest_face));
}

/// The texel that lies across the border of a face at (x, y), one of the two just outside.
struct CubeTexel {
  int face, x, y;
};

CubeTexel across_border(int size, int face, int x, int y) {
  // A point a little outside, so that the neighbour's scale along the edge does not matter.
  constexpr double outside = 1e-6;
  const auto coordinate = [size](int i) {
    if (i < 0) return -outside;
    if (i >= size) return 1 + outside;
    return (i + 0.5) / size;
  };
  const CubePoint point = direction_to_cube(
      cube_to_direction(static_cast<CubeFace>(face), {coordinate(x), coordinate(y)}));
  const auto texel = [size](double u) {
    return std::min(size - 1, std::max(0, static_cast<int>(u * size)));
  };
  return {static_cast<int>(point.face), texel(point.uv.x), texel(point.uv.y)};
}

}  // namespace

SpecularChain::SpecularChain(const Layers& latlong, const ChainOptions& options)
    : turn_(options.rotate_deg) {
  check_size(options.size);
  const ChainPlan plan = plan_chain("filament", options.size);
  sizes_ = plan.sizes;
  roughness_ = plan.roughness;
  long long numbers = 0;
  std::vector<FilterLobe> lobes;
  for (int level = 0; level < levels(); ++level) {
    const int stride = size(level) + 2;
    edges_.push_back(static_cast<float>(size(level)));
    strides_.push_back(stride);
    firsts_.push_back(static_cast<std::int32_t>(numbers));
    numbers += 24LL * stride * stride;
    if (level > 0) lobes.push_back({.alpha = square(roughness(level))});
  }
  texels_.resize(static_cast<size_t>(numbers));
  store_level(0, average_over_texels(latlong, {.size = size(0)}));
  if (lobes.empty()) return;
  const Prefilter prefilter(latlong, lobes);
  for (int level = 1; level < levels(); ++level) {
    const FilterLobe& lobe = lobes[static_cast<size_t>(level) - 1];
    store_level(level, prefilter.filter(lobe, {.size = size(level)}));
  }
}

size_t SpecularChain::texel_index(int level, int face, int x, int y) const {
  const auto at = static_cast<size_t>(level);
  const auto stride = static_cast<size_t>(strides_[at]);
  const size_t row = static_cast<size_t>(face) * stride + static_cast<size_t>(y + 1);
  return static_cast<size_t>(firsts_[at]) + (row * stride + static_cast<size_t>(x + 1)) * 4;
}

Layers SpecularChain::face(int level, CubeFace face) const {
  const int edge = size(level);
  Layers image = make_layers({edge, edge}, {"R", "G", "B"});
  for (int y = 0; y < edge; ++y) {
    for (int x = 0; x < edge; ++x) {
      const float* texel = texels_.data() + texel_index(level, static_cast<int>(face), x, y);
      for (size_t c = 0; c < 3; ++c) image.layers[c].plane.at(x, y) = texel[c];
    }
  }
  return image;
}

void SpecularChain::store_level(int level, const std::vector<Layers>& faces) {
  const int edge = size(level);
  for_rows(6 * edge, [&](int row) {
    const Layers& face = faces[static_cast<size_t>(row / edge)];
    for (int x = 0; x < edge; ++x) {
      float* texel = texels_.data() + texel_index(level, row / edge, x, row % edge);
      for (size_t c = 0; c < 3; ++c) texel[c] = face.layers[c].plane.at(x, row % edge);
    }
  });
  fill_borders(level);
}

// Beyond an edge lies the neighbour's row of texels, beyond a corner the mean of the three texels
// that meet there: seen from either side, a bilinear lookup is then the same on the edge.
void SpecularChain::fill_borders(int level) {
  const int edge = size(level);
  const auto at = [&](int face, int x, int y) {
    return texels_.data() + texel_index(level, face, x, y);
  };
  for (int face = 0; face < 6; ++face) {
    for (int i = 0; i < edge; ++i) {
      for (const auto& [x, y] : {std::pair{i, -1}, {i, edge}, {-1, i}, {edge, i}}) {
        const CubeTexel from = across_border(edge, face, x, y);
        std::copy_n(at(from.face, from.x, from.y), 3, at(face, x, y));
      }
    }
    for (const auto& [x, y] : {std::pair{-1, -1}, {edge, -1}, {-1, edge}, {edge, edge}}) {
      const int inner_x = x < 0 ? 0 : edge - 1, inner_y = y < 0 ? 0 : edge - 1;
      for (int c = 0; c < 3; ++c) {
        at(face, x, y)[c] =
            (at(face, inner_x, inner_y)[c] + at(face, x, inner_y)[c] + at(face, inner_x, y)[c]) /
            3.0f;
      }
    }
  }
}

}  // namespace kiln

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "kiln/math/vec.h"

namespace kiln {

/// The texels of a footprint, each a GGX lobe about its own normal.
struct Facets {
  std::vector<float> x, y, z;  ///< unit normals
  std::vector<float> alpha;

  void add(const Vec3<float>& normal, float roughness);
  int count() const { return static_cast<int>(x.size()); }
};

/// One GGX lobe that stands for a footprint.
struct OneLobe {
  Vec3<float> normal;
  float alpha_x = 1, alpha_y = 1;
  float angle = 0;  ///< of alpha_x, in half turns, in the frame of the normal turned from +z
};

/// How one lobe differs from the average of the facets' distributions of microfacet normals.
struct LobeError {
  double peak = 0;  ///< greatest density of the lobe over that of the average, less 1
  double rms = 0;   ///< of the difference over all half-vectors, over that of the average
};

/// The average is the texels' own: densities D(h) of the facets with equal weights. The integrals
/// are estimated from `samples` half-vectors that are drawn from both sides.
/// @accuracy about 2 / sqrt(samples) of rms
LobeError lobe_error(const Facets& facets, const OneLobe& lobe, int samples, uint32_t seed);

}  // namespace kiln

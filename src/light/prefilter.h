// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "kiln/image/layers.h"
#include "kiln/math/vec.h"

namespace kiln {

/// Faces px nx py ny pz nz one after another, each row by row from the top.
using CubeTexels = std::vector<Vec3<float>>;

/// A level to be filtered.
struct FilteredLevel {
  int size;      ///< edge of a face [texel]
  double alpha;  ///< width of the GGX lobe
};

/// How many times finer a source has to be made before filtering, each way.
struct Refinement {
  int across = 1, down = 1;
};

/// So fine that the sharpest lobe covers some texels, and that a row of the constant 1 has no wave
/// but the constant.
Refinement refinement_for(Size source, const std::vector<FilteredLevel>& levels);

/// The environment convolved with a GGX lobe under normal = view = direction, at the texel centres
/// of each level, as SpecularChain states. All levels share one expansion.
/// @param latlong  values at texel centres, finite
/// @valid alpha in [4e-3, 1]
std::vector<CubeTexels> prefilter(const Layers& latlong, const std::vector<FilteredLevel>& levels);

/// The environment averaged over the area of each cube texel.
CubeTexels average_over_texels(const Layers& latlong, int size);

/// The image that many times as wide and as high, by bilinear interpolation.
Layers finer(const Layers& latlong, const Refinement& times);

}  // namespace kiln

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "kiln/light/prefilter.h"

namespace kiln {

/// How far a filtered level is from the sum that it stands for, relative to the mean radiance.
struct FilterError {
  double rms = 0, max = 0;
};

/// A filtered level as Prefilter::filter made it.
struct FilteredLevel {
  FilterLobe lobe;
  SphereGrid grid;
  std::vector<Layers> images;
};

/// The error of each level by brute force over every texel of the source, at up to ten texels
/// spread over the level, the brightest one and one beside it.
/// @param mean_radiance  of the source, as luminance
std::vector<FilterError> filter_errors(const Prefilter& prefilter,
                                       const std::vector<FilteredLevel>& levels,
                                       double mean_radiance);

}  // namespace kiln

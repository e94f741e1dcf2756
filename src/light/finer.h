// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "kiln/image/layers.h"

namespace kiln {

/// How many times finer a source has to be made before filtering, each way.
struct Refinement {
  int across = 1, down = 1;
};

/// So fine that the constant 1 has no wave around its rings but the constant, up to that order.
Refinement refinement_for(Size source, int order);

/// The image that many times as wide and as high, by bilinear interpolation.
Layers finer(const Layers& latlong, const Refinement& times);

}  // namespace kiln

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "kiln/image/layers.h"

namespace kiln {

/// How two images of one size and the same channels differ, over all texels and channels.
struct Difference {
  double mean = 0;  ///< mean absolute difference
  double rms = 0;
  double percentile_95 = 0;  ///< of the absolute difference
  double max = 0;
};

/// @error Fault::Input when sizes or channel names differ
Difference compare(const Layers& a, const Layers& b);

}  // namespace kiln

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "kiln/image/layers.h"

namespace kiln {

/// What becomes of values that are NaN or infinite. Negative radiance is kept and counted.
enum class Fix { None, Zero, Neighbors };

/// Values (texels times channels) found in an image before anything was replaced.
struct Fixed {
  long long nan = 0, inf = 0, negative = 0;
};

/// Replaces NaN and Inf in place: by zero, or by the mean of the finite values on the smallest
/// square ring around them that has any (8 neighbours, then 16, ...), wrapping around horizontally
/// and ending at the poles. Values replaced earlier never count as finite. A channel without any
/// finite value becomes zero.
Fixed fix_radiance(Layers& latlong, Fix fix);

/// A node-aligned lat-long image (first column = last, pole rows constant) as one with values at
/// texel centres, a column and a row smaller: each texel is the exact mean over itself of the
/// bilinear surface through its four corners.
/// @error Fault::Input when there are fewer than 2 columns or rows
Layers texel_centred(const Layers& node_aligned);

}  // namespace kiln

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "kiln/image/layers.h"

namespace kiln {

/// What becomes of values that are NaN or infinite. Negative radiance is kept and counted.
enum class Fix { None, Zero, Neighbors };

/// What lies beyond the left and the right edge of an image: the other one, or nothing.
enum class Edges { Around, End };

/// Values (texels times channels) found in an image before anything was replaced.
struct Fixed {
  long long nan = 0, inf = 0, negative = 0;
  std::optional<TexelPlace> first;  ///< that was not finite
};

/// Replaces NaN and Inf in place: by zero, or by the mean of the finite values on the smallest
/// square ring around them that has any (8 neighbours, then 16, ...), ending at the poles. Values
/// replaced earlier never count as finite. A channel without any finite value becomes zero.
/// @param edges  Around for a lat-long image, End for a face of a cube or an octahedral image
Fixed fix_radiance(Layers& image, Fix fix, Edges edges = Edges::Around);

/// A node-aligned lat-long image (first column = last, pole rows constant) as one with values at
/// texel centres, a column and a row smaller: each texel is the exact mean over itself of the
/// bilinear surface through its four corners.
/// @error Fault::Input when there are fewer than 2 columns or rows
Layers texel_centred(const Layers& node_aligned);

}  // namespace kiln

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "color_planes.h"
#include "kiln/image/layers.h"

namespace kiln {

// Averages over texels whose sides are meridians, the texels of the source taken as boxes: those of
// a lat-long image, and of the four side faces of a cube, where s = tan(phi). A column first takes
// its share of the source's columns; then, down the column, each texel is a difference of running
// sums over z = cos(theta) between its edges. What one texel gains its neighbour loses, so no power
// is lost in between.

/// Over the four side faces; the other two stay as they are.
/// @param turns  of the environment, positive turns +Z toward +X [turn]
/// @param faces  six, of one size
void average_over_sides(const ColorPlanes& source, double turns, std::vector<Layers>& faces);

/// Over the texels of a lat-long image.
void average_over_latlong(const ColorPlanes& source, double turns, Layers& image);

}  // namespace kiln

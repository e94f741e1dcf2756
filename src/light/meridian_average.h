// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "color_planes.h"
#include "hot_texels.h"
#include "kiln/image/layers.h"

namespace kiln {

// Averages over texels whose sides are meridians, the texels of the source taken as boxes: those of
// a lat-long image, and of the four side faces of a cube, where s = tan(phi). A column first takes
// its share of the source's columns; then, down the column, each texel is a difference of running
// sums over z = cos(theta) between its edges. What one texel gains its neighbour loses, so no power
// is lost in between.

/// Over the four side faces, radiance above the limit counting as the limit; the other two stay as
/// they are.
/// @param faces  six, of one size
void average_over_sides(const ColorPlanes& source, const PowerLimit& limit,
                        std::vector<Layers>& faces);

/// Over the texels of a lat-long image.
void average_over_latlong(const ColorPlanes& source, Layers& image);

}  // namespace kiln

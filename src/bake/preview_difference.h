// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "kiln/image/bands.h"
#include "kiln/image/layers.h"

namespace kiln {

// A difference of two pictures as one looks at it: the luminance of each pixel in false colours,
// white where there is none, red where the first is too bright, blue where it is too dark.

/// A scale of 1, 2 or 5 times a power of ten that all but one in two hundred of the pixels shown
/// stay within; those whose difference is not finite do not count.
double difference_scale(const std::vector<const Layers*>& differences);

/// Planes R G B A as a display shows them (sRGB); +-scale is full colour, what lies beyond is
/// clamped.
Layers paint_difference(const Layers& difference, double scale);

/// A bar of the colours with numbers.
/// @param size  of the strip
Layers difference_legend(Size size, double scale);

/// One picture with its legend below.
Layers difference_view(const Layers& difference);

/// Of each pixel, what the view of a difference shows.
Plane difference_luminance(const Layers& difference);

/// The same view, a band of rows at a time, of a picture that shows the surface everywhere.
ImageBands difference_bands(Plane luminance);

}  // namespace kiln

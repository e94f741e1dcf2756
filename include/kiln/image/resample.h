// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "kiln/image/layers.h"

namespace kiln {

/// The plane at another size: exact area average where it shrinks, bilinear where it grows (texel
/// centres aligned, edges clamped), each axis by its own. A constant stays that constant.
Plane resample(const Plane& plane, Size size);
Layers resample(const Layers& image, Size size);

/// Half the size (each axis halved, rounded up, at least 1) by exact area average.
Plane halve(const Plane& plane);

}  // namespace kiln

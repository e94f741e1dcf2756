// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "kiln/material/slot_values.h"

namespace kiln {

/// plane = min(plane * factor, most)
void multiply(Plane& plane, const Plane& factor, float most);

/// Makes NaN and Inf 0. @return how many there were
long long replace_unreadable(Plane& plane);

/// Angles [rad] of what decode_slot() makes of an image of angles.
Plane angle_of_axes(const Layers& axes);

/// Roughness and the strength of an anisotropy as they are stored, as an SVBRDF holds them.
void bring_to_shape(AnisotropyEncoding encoding, Plane& roughness, Plane& anisotropy);

}  // namespace kiln

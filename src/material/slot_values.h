// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "kiln/material/workflow.h"

namespace kiln {

/// Applies the decoding of a slot to its image or constant: roughness becomes perceptual, an angle
/// [rad] one plane, then values are scaled and offset. What an anisotropy stands for needs the
/// roughness beside it and is left to bring_to_shape(), the components of normals to
/// decode_normals(). NaN and Inf stay.
void decode_slot(Slot slot, SlotMap& map);

/// plane = min(plane * factor, most)
void multiply(Plane& plane, const Plane& factor, float most);

/// Makes NaN and Inf 0. @return how many there were
long long replace_unreadable(Plane& plane);

/// Angles [rad] of axes, which are the same after half a turn, at another size.
Plane resample_angle(Plane angle, Size size);

/// Roughness and the strength of an anisotropy as they are stored, as an SVBRDF holds them.
void bring_to_shape(AnisotropyEncoding encoding, Plane& roughness, Plane& anisotropy);

}  // namespace kiln

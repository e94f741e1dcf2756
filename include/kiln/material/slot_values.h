// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "kiln/material/workflow.h"

namespace kiln {

/// Applies the decoding of a slot to its image or constant: roughness becomes perceptual, then
/// values are scaled and offset. An angle becomes [rad] where it is a constant, and in an image two
/// planes, cosine and sine of twice the angle: angles of axes turn round after half a turn, and
/// these can be resampled. What an anisotropy stands for needs the roughness beside it and is left
/// to the resolver, components of normals to decode_normals(). NaN and Inf stay.
/// @error Fault::Input for a direction of one channel
void decode_slot(Slot slot, SlotMap& map);

}  // namespace kiln

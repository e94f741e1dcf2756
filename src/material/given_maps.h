// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "kiln/material/workflow.h"

namespace kiln {

/// Values of a slot that mean something; others are clamped.
struct Bounds {
  float low = 0;
  float high = 1;
};
Bounds bounds_of(const SlotMaps& maps, Slot slot);

/// The first given slot of the list, else the first: its constant stands in.
Slot choose(const SlotMaps& maps, const std::vector<Slot>& alternatives);

/// What is given for the slot, where it is an image.
const SlotMap* given_image(const SlotMaps& maps, Slot slot);

}  // namespace kiln

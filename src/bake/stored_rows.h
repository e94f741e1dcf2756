// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "kiln/bake/bake.h"

namespace kiln {

/// The slot that holds the same: gloss, inverted, of roughness, diffuse of base colour, and the
/// other way round; of others the slot itself.
Slot stand_in(Slot slot);

/// The map of a slot, or of its stand-in; nothing where neither is given.
const GivenMap* standing_for(const MapBands& maps, Slot slot);

/// Rows of one channel of a slot as stored, from the map that stands for it or its constant.
Plane stored_channel(const SlotMaps& rows, const GivenMap* map, Slot slot, int channel, Size size);

/// Rows of a normal map in a convention, as stored: green turned where that differs, and all three
/// encoded anew where the file holds two channels or signed numbers.
Layers stored_normals(const SlotMap& rows, const NormalForm& form, NormalConvention convention);

/// Unit normals, +Y up, as a file of that convention stores them: (n + 1) / 2.
Layers encoded_normals(std::array<Plane, 3> normal, NormalConvention convention);

/// 1 - v of every texel.
void invert(Plane& plane);

}  // namespace kiln

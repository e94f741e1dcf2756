// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "kiln/image/layers.h"
#include "kiln/math/vec.h"

namespace kiln {

// Pictures put together from pictures.

/// An opaque image R G B A of one colour.
Layers make_sheet(Size size, const Vec3<float>& color);

struct Corner {
  int x = 0, y = 0;
};

/// Lays the planes R G B A of a picture over a sheet, its upper left corner at `at`, as far as it
/// reaches. Alpha is unassociated in both.
void place(const Layers& picture, Corner at, Layers& sheet);

/// What a display that encodes as sRGB does shows [0..1], and back.
float to_srgb(float linear);
float from_srgb(float code);

}  // namespace kiln

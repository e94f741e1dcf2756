// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "kiln/image/layers.h"
#include "kiln/math/vec.h"

namespace kiln {

// Captions: letters of single strokes with round ends, drawn at any size.

struct Lettering {
  double height = 12;                 ///< of capitals [texel]
  Vec3<float> ink{0.8f, 0.8f, 0.8f};  ///< in the numbers of the image
};

/// How wide a line of text is [texel].
double text_width(std::string_view text, double height);

/// The text, ended by "..." where it would be wider than `width`.
std::string text_within(std::string_view text, double height, double width);

/// Draws a line of text over the planes R G B of an image, `left` and `baseline` in texels.
void draw_text(Layers& image, Vec2<double> left_baseline, std::string_view text,
               const Lettering& lettering);

/// The strokes of a letter of ASCII, else of a box. Each stroke is a chain of points, two digits
/// each, x to the right and y down: capitals stand from 0 to 6, small letters from 2, what hangs
/// below ends at 8. Strokes are separated by spaces.
std::string_view strokes_of(char letter);

}  // namespace kiln

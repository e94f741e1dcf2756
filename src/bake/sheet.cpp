// SPDX-License-Identifier: Apache-2.0
#include "sheet.h"

#include <algorithm>
#include <cmath>

namespace kiln {
namespace {

// One texel over another, alpha unassociated.
void lay_over(const Layers& picture, int px, int py, Layers& sheet, int x, int y) {
  const float a = picture.layers[3].plane.at(px, py);
  float& below = sheet.layers[3].plane.at(x, y);
  const float kept = below * (1 - a), together = a + kept;
  for (size_t c = 0; c < 3 && together > 0; ++c) {
    float& texel = sheet.layers[c].plane.at(x, y);
    texel = (picture.layers[c].plane.at(px, py) * a + texel * kept) / together;
  }
  below = together;
}

}  // namespace

Layers make_sheet(Size size, const Vec3<float>& color) {
  return {size,
          {{"R", Plane(size, color.x)},
           {"G", Plane(size, color.y)},
           {"B", Plane(size, color.z)},
           {"A", Plane(size, 1.0f)}}};
}

void place(const Layers& picture, Corner at, Layers& sheet) {
  const int x0 = std::max(at.x, 0), x1 = std::min(at.x + picture.size.width, sheet.size.width);
  const int y0 = std::max(at.y, 0), y1 = std::min(at.y + picture.size.height, sheet.size.height);
  for (int y = y0; y < y1; ++y) {
    for (int x = x0; x < x1; ++x) lay_over(picture, x - at.x, y - at.y, sheet, x, y);
  }
}

float to_srgb(float linear) {
  const float v = std::clamp(linear, 0.0f, 1.0f);
  return v <= 0.0031308f ? 12.92f * v : 1.055f * std::pow(v, 1 / 2.4f) - 0.055f;
}

float from_srgb(float code) {
  const float v = std::clamp(code, 0.0f, 1.0f);
  return v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f);
}

}  // namespace kiln

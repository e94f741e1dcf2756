// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "kiln/table/ltc.h"

namespace kiln {

// With w the angle to the middle, s the angular radius and sin g = cos s / sin w, a cap cut by the
// horizon has the projected solid angle
//
//     G = pi/2 - g - 2 sin w cos s cos g + sin g cos g
//     H = cos w (cos g sqrt(sin^2 s - cos^2 g) + sin^2 s asin(cos g / sin s))
//     pi cos w sin^2 s + G - H   with the middle above the horizon,   G + H   with it below.
double sphere_form_factor(double cosine, double sine2) {
  const double z = std::clamp(cosine, -1.0, 1.0), s2 = std::clamp(sine2, 0.0, 1.0);
  if (s2 < 1e-12) return std::max(z, 0.0);
  const double sine_s = std::sqrt(s2), cosine_s = std::sqrt(1 - s2);
  const double sine_w = std::sqrt((1 - z) * (1 + z));
  if (sine_w <= cosine_s) return std::max(z, 0.0);  // whole, above or below
  const double sine_g = cosine_s / sine_w, g = std::asin(sine_g);
  const double cosine_g = std::sqrt((1 - sine_g) * (1 + sine_g));
  const double big_g = pi / 2 - g - 2 * sine_w * cosine_s * cosine_g + sine_g * cosine_g;
  const double root = std::sqrt(std::max(s2 - cosine_g * cosine_g, 0.0));
  const double big_h =
      std::abs(z) * (cosine_g * root + s2 * std::asin(std::min(cosine_g / sine_s, 1.0)));
  const double solid_angle = z >= 0 ? pi * z * s2 + big_g - big_h : big_g - big_h;
  return solid_angle / (pi * s2);
}

}  // namespace kiln

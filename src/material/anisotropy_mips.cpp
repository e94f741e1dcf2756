// SPDX-License-Identifier: Apache-2.0
#include "anisotropy_mips.h"

#include <algorithm>
#include <cmath>

#include "kiln/image/resample.h"
#include "kiln/material/anisotropy.h"

namespace kiln {
namespace {

/// Twice the covariance of the slopes.
struct Covariance {
  Plane xx, xy, yy;
};

Covariance covariance_of(const Svbrdf& svbrdf) {
  const Size size = svbrdf.size;
  Covariance sum{Plane(size), Plane(size), Plane(size)};
  for (int row = 0; row < size.height; ++row) {
    for (int i = 0; i < size.width; ++i) {
      const LobeWidths alpha =
          anisotropic_widths({svbrdf.roughness.row(row)[i], svbrdf.anisotropy.row(row)[i]});
      const float angle = svbrdf.anisotropy_angle.empty() ? 0 : svbrdf.anisotropy_angle.row(row)[i];
      const float c = std::cos(angle), s = std::sin(angle);
      const float x = alpha.x * alpha.x, y = alpha.y * alpha.y;
      sum.xx.row(row)[i] = x * c * c + y * s * s;
      sum.xy.row(row)[i] = (x - y) * c * s;
      sum.yy.row(row)[i] = x * s * s + y * c * c;
    }
  }
  return {halve(sum.xx), halve(sum.xy), halve(sum.yy)};
}

}  // namespace

void halve_anisotropic(const Svbrdf& svbrdf, Svbrdf& half) {
  const Covariance sum = covariance_of(svbrdf);
  const Size size = sum.xx.size();
  half.roughness = half.anisotropy = half.anisotropy_angle = Plane(size);
  for (int row = 0; row < size.height; ++row) {
    for (int i = 0; i < size.width; ++i) {
      const float mean = 0.5f * (sum.xx.row(row)[i] + sum.yy.row(row)[i]);
      const float difference = 0.5f * (sum.xx.row(row)[i] - sum.yy.row(row)[i]);
      const float xy = sum.xy.row(row)[i];
      const float spread = std::sqrt(difference * difference + xy * xy);
      const LobeShape shape = lobe_shape(LobeWidths{std::sqrt(std::max(mean + spread, 0.0f)),
                                                    std::sqrt(std::max(mean - spread, 0.0f))});
      half.roughness.row(row)[i] = shape.roughness;
      half.anisotropy.row(row)[i] = shape.anisotropy;
      half.anisotropy_angle.row(row)[i] = 0.5f * std::atan2(xy, difference);
    }
  }
}

}  // namespace kiln

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "color_planes.h"
#include "hot_texels.h"
#include "kiln/light/prefilter.h"
#include "legendre.h"

namespace kiln {

/// a_lm of three colours: re and im of red, of green, of blue.
using ColorCoefficient = std::array<double, 6>;

/// The expansion of point masses at the texel centres of a lat-long image, m >= 0; a_l-m is the
/// conjugate.
struct Expansion {
  int order = 0;
  std::vector<std::vector<ColorCoefficient>> columns;  ///< [m][l - m]
  std::vector<double> constant;  ///< a_l0 of the constant 1 as point masses, [order + 1]
};

/// a_lm = sum over texels of radiance times conj(Y_lm) times solid angle, which is exact for the
/// point masses whatever the order.
/// @param across   Straight spreads each texel over its neighbours as linear interpolation does,
///                 exactly: on a ring that multiplies wave m by sinc^2(m / width)
/// @param limit    texels with more power are left out, colour by colour
/// @param columns  of all m up to the order
/// @valid order < width, order < 1900
Expansion analyse(const ColorPlanes& latlong, Across across, const PowerLimit& limit,
                  const std::vector<LegendreColumn>& columns);

}  // namespace kiln

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "kiln/bake/bake.h"
#include "kiln/light/sphere_layout.h"

namespace kiln {

/// What storing an environment as a pixel type costs.
struct EncodingLoss {
  double rms = 0, max = 0;  ///< over all levels, relative to the mean radiance
  long long clamped = 0;    ///< values beyond the range of the type
  double lost_energy = 0;   ///< of the first level, as a share of its power

  bool operator==(const EncodingLoss&) const = default;
};

/// @param levels  [levels][images]
/// @param mean    luminance of the mean radiance
EncodingLoss measure_encoding(const std::vector<std::vector<Layers>>& levels,
                              const SphereGrid& first, const std::string& pixel_type, double mean,
                              const Coded& coded);

}  // namespace kiln

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "kiln/math/wide.h"

namespace kiln {

/// The lanes of a wide number, added from first to last.
inline double sum_lanes(WideDouble values) {
  double lane[lane_count<WideDouble>];
  store_lanes(lane, values);
  double sum = 0;
  for (const double value : lane) sum += value;
  return sum;
}

}  // namespace kiln

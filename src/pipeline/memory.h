// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "kiln/pipeline/plan.h"

namespace kiln {

/// How a set is read: rows of a band, and how many bands are on their way at once.
struct BandPlan {
  int rows = 64;
  int at_once = 6;
};

/// Memory of rows of a set, from what is read to what is written.
struct RowCost {
  long long width = 0;  ///< of the set [texel]
  int planes = 0;       ///< float planes of a band at its most
  int channels = 0;     ///< of the files, which are decoded in blocks of rows of their own
};

/// @param channels_read  of all files together
RowCost row_cost(Size set, int channels_read, bool resolved);

/// Bands that fit into the budget beside what the process needs anyway; the default without one.
/// @error Fault::Memory when not even one narrow band fits
BandPlan plan_bands(const RowCost& cost, long long budget);

/// Bytes that the process takes at most while it holds such bands.
long long bytes_of(const RowCost& cost, const BandPlan& bands);

/// Bytes of a set that is held as one BRDF per texel, reduced, with its mip levels.
long long bytes_of_material(Size set, int halvings);

/// How often a set of that size may be halved and still be read at every texel.
/// @param wanted  as Needs::material_for; no width: never
int halvings_of(Size set, Size wanted);

/// Refuses what does not fit. @error Fault::Memory
void require_memory(long long bytes, long long budget, const std::string& what);

}  // namespace kiln

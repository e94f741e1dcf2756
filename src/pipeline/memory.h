// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "kiln/pipeline/plan.h"

namespace kiln {

/// How a set is read: rows of a band, and how many bands are on their way at once.
struct BandPlan {
  int rows = 64;  ///< a multiple of band_unit
  int at_once = 6;
};

/// Memory of rows of a set, from what is read to what is written.
struct RowCost {
  long long width = 0;  ///< of the set [texel]
  double planes = 0;    ///< float planes of every band on its way
  double working = 0;   ///< and of those that are being computed
  int channels = 0;     ///< of the files, which are decoded in blocks of rows of their own
  long long held = 0;   ///< beside the bands, until the last is made [byte]
};

/// Of a task that reads maps band by band.
RowCost cost_of_rows(const Plan& plan, const Task& task);

/// Bands that fit into the budget beside what the process needs anyway, or else the narrowest; the
/// default without a budget.
BandPlan plan_bands(const RowCost& cost, long long budget);

/// Bytes that the process takes at most while it holds such bands.
long long bytes_of(const RowCost& cost, const BandPlan& bands);

/// plan_bands, where they do fit. @error Fault::Memory
BandPlan require_bands(const RowCost& cost, long long budget);

/// What the files of a set that such needs read come to.
struct SetCost {
  Size size{1, 1};     ///< of the largest
  int channels = 0;    ///< of all together
  int planes = 11;     ///< of one BRDF per texel: anisotropy and its angle are one more each
  long long held = 0;  ///< of files that cannot be read row by row [byte]
};
SetCost cost_of_set(const PlannedSet& set, const MapNeeds& needs);

/// Bands of a set that is held as one BRDF per texel, so often halved, with its mip levels: a
/// multiple of 2^halvings rows.
BandPlan bands_of_material(const SetCost& set, int halvings, long long budget);

/// Bytes that the process takes at most with such a set and a picture of it.
long long bytes_of_material(const SetCost& set, int halvings, const BandPlan& bands, Size picture);

/// How often a set of that size may be halved and still be read at every texel.
/// @param wanted  as Needs::material_for; no width: never
int halvings_of(Size set, Size wanted);

/// Refuses what does not fit. @error Fault::Memory
void require_memory(long long bytes, long long budget, const std::string& what);

}  // namespace kiln

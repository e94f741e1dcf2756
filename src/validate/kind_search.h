// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "kiln/validate/verify.h"
#include "kinds.h"
#include "sheet.h"

namespace kiln::validate {

/// Axes under which a sheet is read as a kind.
struct KindReading {
  int kind = 0;
  std::vector<const AxisMapping*> mappings;  ///< of the kind's quantities
  std::vector<int> order;                    ///< quantity that runs along x, y, z
  std::vector<bool> reversed;                ///< x, y, z count from the other end
  Alignment alignment = Alignment::Center;
};

/// What a channel holds of a kind.
struct KindFit {
  int content = -1;  ///< of the kind; -1: nothing, or one value everywhere
  bool constant = false;
  double level = 0;
  double rms = 1e9;
};

struct KindCandidate {
  int sheet = 0;
  KindReading reading;
  std::vector<KindFit> fits;
  double score = 1;  ///< mean rms error of channels that vary
};

/// All readings of all sheets as kinds with as many axes, on a few entries: the best one first,
/// then the best of those that mean something else.
std::vector<KindCandidate> search_kinds(const std::vector<Sheet>& sheets);

/// A candidate compared with up to `most` entries along each axis.
struct KindComparison {
  std::vector<std::vector<int>> places;  ///< along x, y, z
  Coordinates coordinates;               ///< of those entries, along x, y, z
  Values values, exact;                  ///< [channel][z][y][x]
  std::vector<KindFit> fits;             ///< with their errors measured here
};
KindComparison compare(const Sheet& sheet, const KindCandidate& candidate, int most);

}  // namespace kiln::validate

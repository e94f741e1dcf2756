// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "kiln/material/normal_survey.h"
#include "kiln/material/svbrdf.h"
#include "kiln/material/workflow.h"

namespace kiln {

/// What was repaired in the texels of a material; those of bands add up.
struct Repairs {
  struct OfSlot {
    long long clamped = 0, unreadable = 0;
  };
  std::array<OfSlot, slot_list.size()> slots = {};
  long long normals = 0;  ///< that were decoded; of these:
  long long not_unit = 0, degenerate = 0, below_surface = 0, unreadable_normals = 0;

  void add(const Repairs& other);
};

/// The size that maps share once resampled: that of the largest of these slots, 1x1 where all are
/// constants.
/// @param heads  images of which only size and name are looked at
/// @error Fault::Input naming two maps whose aspects differ by more than rounding
Size shared_size(const SlotMaps& heads, const std::vector<Slot>& slots);

/// Named maps to one BRDF per texel, rows at a time: what is decided once for all of them.
class Resolver {
 public:
  /// @param heads   what is given, read or not: constants, and images of which only the size and
  ///                the names of layers are looked at
  /// @param normal  of the normal map, where it is an image
  /// @error as shared_size
  Resolver(SlotMaps heads, const WorkflowSettings& settings, std::optional<NormalForm> normal);

  /// The slots that are read, out of those given.
  const std::vector<Slot>& read() const { return read_; }
  /// shared_size() of these.
  Size size() const { return size_; }

  /// Rows of the SVBRDF. May be called from many threads.
  /// @param maps     the same rows of every map that is read, resampled to the width of size();
  ///                 colours in the working space, numbers as decode_slot() leaves them
  /// @param repairs  what was repaired is added
  Svbrdf rows(SlotMaps maps, Repairs& repairs) const;

  /// What was assumed, resampled, repaired or left out, and what may be wrong.
  std::vector<std::string> notes(const Repairs& repairs) const;
  std::vector<std::string> warnings(const Repairs& repairs) const;

 private:
  SlotMaps heads_;
  WorkflowSettings settings_;
  std::optional<NormalForm> normal_;
  std::vector<Slot> read_;
  Size size_;
};

}  // namespace kiln

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "kiln/image/mip_levels.h"
#include "kiln/material/lobe_error.h"
#include "mip_maps.h"

namespace kiln {

/// Files of maps with all their levels, made band by band.
class MipFilter {
 public:
  /// @param judged  which of the maps is roughness that normals widen, whose lobes are compared
  ///                with their footprints here and there; -1: none
  MipFilter(std::vector<MipMap> maps, const std::vector<Size>& sizes, int judged);

  /// What is complete once this band follows those before.
  std::vector<MipRows> add(const MipBand& band);
  /// Means of the levels, and errors of the lobes.
  std::vector<std::pair<std::string, double>> figures() const;

 private:
  struct InWork {
    MipMap map;
    MipCascade cascade;
    std::vector<double> energy;  ///< [levels], sums
    std::vector<MipRows> made;
  };
  void add(const MipBand& band, size_t file);
  void store(InWork& work, const LevelRows& averages, size_t file) const;
  void judge(const MipBand& band, const std::vector<MipRows>& made);

  std::vector<InWork> maps_;
  std::vector<Size> sizes_;
  int judged_;
  std::vector<std::vector<LobeError>> errors_;  ///< [levels][texels]
};

}  // namespace kiln

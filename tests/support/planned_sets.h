// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "kiln/pipeline/plan.h"
#include "workshop.h"

namespace kiln::test {

/// The sets that a document of materials in a workshop comes to.
/// @param keys  more of the entry of `sets`: ", name: hero"
inline std::vector<PlannedSet> sets_of_document(const std::filesystem::path& file,
                                                const std::string& keys = "") {
  const auto pipeline = file.parent_path() / "p.yaml";
  std::ofstream(pipeline) << "version: 1\nsets: [{ path: " << file.filename().string() << keys
                          << " }]\nbakes: []\n";
  return planned_sets(read_pipeline(pipeline));
}

/// Why the only set cannot be read, which must be its input's fault.
inline std::string input_fault_of(const std::vector<PlannedSet>& sets) {
  if (sets.size() != 1 || !sets[0].fault) return "no fault";
  EXPECT_EQ(sets[0].fault->fault(), Fault::Input);
  return sets[0].fault->what();
}

inline const PlannedMap& map_of(const PlannedSet& set, Slot slot) {
  for (const PlannedMap& map : set.maps) {
    if (map.slot == slot) return map;
  }
  throw std::runtime_error("no map for " + std::string(slot_name(slot)));
}

}  // namespace kiln::test

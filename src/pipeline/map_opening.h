// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "kiln/bake/bake.h"
#include "kiln/io/image_rows.h"
#include "kiln/pipeline/plan.h"

namespace kiln {

/// The maps of a set that such needs read. Others affect neither size nor outcome: they are not
/// even opened.
std::vector<PlannedMap> maps_needed(const PlannedSet& set, const MapNeeds& needs);

/// @error Fault::Input naming every file that is missing
void require_files(const std::vector<PlannedMap>& maps);

FileFacts facts_of_file(const PlannedMap& map);

/// Channels of a file that any of the maps takes: the others need not be unpacked.
std::vector<std::string> wanted_channels(const std::filesystem::path& path, const FileFacts& facts,
                                         const std::vector<PlannedMap>& maps);

/// What is known of a map before its texels, but its size.
SlotMap head_of(const PlannedMap& map);

/// The file of a map from its first row, with these channels or all.
ImageRows rows_of(const PlannedMap& map, const std::vector<std::string>& channels = {});

/// All rows of a map as stored. No more is held beside them than a few rows of its file.
Layers whole_map(const PlannedMap& map);

}  // namespace kiln

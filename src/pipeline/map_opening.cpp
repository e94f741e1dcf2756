// SPDX-License-Identifier: Apache-2.0
#include "map_opening.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "kiln/material/workflow.h"

namespace kiln {

namespace fs = std::filesystem;

std::vector<PlannedMap> maps_needed(const PlannedSet& set, const MapNeeds& needs) {
  std::vector<Slot> read = needs.stored, given;
  for (const PlannedMap& map : set.maps) given.push_back(map.slot);
  if (needs.resolved) {
    for (const Slot slot : slots_read(set.reading.workflow, given)) read.push_back(slot);
  }
  std::vector<PlannedMap> needed;
  for (const PlannedMap& map : set.maps) {
    if (std::count(read.begin(), read.end(), map.slot)) needed.push_back(map);
  }
  return needed;
}

void require_files(const std::vector<PlannedMap>& maps) {
  std::string missing;
  std::error_code failure;
  for (const PlannedMap& map : maps) {
    if (map.path.empty() || map.embedded.bytes || fs::exists(map.path, failure)) continue;
    missing += fmt::format("{}{} ({})", missing.empty() ? "" : ", ", map.path.string(),
                           slot_name(map.slot));
  }
  if (!missing.empty()) throw Error(Fault::Input, "no such file: " + missing);
}

FileFacts facts_of_file(const PlannedMap& map) {
  return map.embedded.bytes ? inspect_image(map.embedded) : inspect_image(map.path);
}

std::vector<std::string> wanted_channels(const fs::path& path, const FileFacts& facts,
                                         const std::vector<PlannedMap>& maps) {
  std::set<std::string> wanted;
  for (const PlannedMap& map : maps) {
    if (map.path != path || (map.if_present && !has_channels(facts.channels, map.channels))) {
      continue;
    }
    const auto names = with_context(path.string(), [&] {
      return picked_names(facts.channels, slot_channels(facts.channels, map.slot, map.channels));
    });
    wanted.insert(names.begin(), names.end());
  }
  return {wanted.begin(), wanted.end()};
}

SlotMap head_of(const PlannedMap& map) {
  SlotMap head;
  head.convention = map.convention;
  head.encoding = map.encoding;
  head.decoding = map.decoding;
  head.source = map.path.filename().string();
  return head;
}

ImageRows rows_of(const PlannedMap& map, const std::vector<std::string>& channels) {
  return map.embedded.bytes ? ImageRows(map.embedded, channels) : ImageRows(map.path, channels);
}

Layers whole_map(const PlannedMap& map) {
  constexpr int rows_at_once = 64;
  ImageRows rows = rows_of(map, wanted_channels(map.path, facts_of_file(map), {map}));
  const Size size = rows.facts().size;
  Layers whole{size, {}};
  for (int first = 0; first < size.height; first += rows_at_once) {
    const Layers band =
        pick_slot(rows.next(std::min(rows_at_once, size.height - first)), map.slot, map.channels);
    for (size_t c = 0; c < band.layers.size(); ++c) {
      if (first == 0) whole.add(band.layers[c].name);
      for (int y = 0; y < band.size.height; ++y) {
        const auto row = band.layers[c].plane.texels_of_row(y);
        std::copy(row.begin(), row.end(), whole.layers[c].plane.row(first + y));
      }
    }
  }
  return whole;
}

}  // namespace kiln

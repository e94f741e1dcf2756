// SPDX-License-Identifier: Apache-2.0
#include "tiles.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>

#include "glob.h"
#include "kiln/material/udim.h"

namespace kiln {
namespace {

namespace fs = std::filesystem;

// The tiles of each pattern.
using Tiles = std::map<fs::path, std::map<int, fs::path>>;

std::map<int, fs::path> tiles_on_disk(const fs::path& pattern) {
  const fs::path folder = pattern.has_parent_path() ? pattern.parent_path() : fs::path(".");
  if (has_tile(folder.string())) {
    throw Error(Fault::Input,
                fmt::format("{}: the tile stands in the name of a folder, expected in the file's",
                            pattern.string()));
  }
  std::map<int, fs::path> tiles;
  for (const std::string& file : files_in(folder)) {
    const auto tile = tile_of(pattern.filename().string(), file);
    if (tile) tiles.emplace(*tile, pattern.has_parent_path() ? folder / file : fs::path(file));
  }
  return tiles;
}

bool has_patterns(const PlannedSet& set) {
  return std::any_of(set.maps.begin(), set.maps.end(),
                     [](const PlannedMap& map) { return has_tile(map.path.string()); });
}

Tiles tiles_of(const PlannedSet& set) {
  Tiles tiles;
  for (const PlannedMap& map : set.maps) {
    if (has_tile(map.path.string()) && !tiles.count(map.path)) {
      tiles[map.path] = tiles_on_disk(map.path);
    }
  }
  return tiles;
}

std::set<int> numbers_of(const Tiles& tiles) {
  std::set<int> numbers;
  for (const auto& [pattern, files] : tiles) {
    for (const auto& [number, file] : files) numbers.insert(number);
  }
  return numbers;
}

Error no_tiles(const Tiles& tiles) {
  std::vector<std::string> patterns;
  for (const auto& [pattern, files] : tiles) patterns.push_back(pattern.string());
  return {Fault::Input, fmt::format("no file is a tile of {}", fmt::join(patterns, " or of "))};
}

// Which slots a tile lacks, by the file that is missing.
using Lacking = std::map<std::string, std::vector<std::string>>;

std::string told(const Lacking& lacking) {
  std::vector<std::string> files;
  for (const auto& [file, slots] : lacking) {
    files.push_back(fmt::format("{} (no file {})", fmt::join(slots, ", "), file));
  }
  return fmt::format("{}", fmt::join(files, ", "));
}

bool is_shaded(const PlannedSet& set) {
  std::vector<Slot> slots;
  for (const PlannedMap& map : set.maps) slots.push_back(map.slot);
  return !slots_read(set.reading.workflow, slots).empty();
}

PlannedSet one_tile(const PlannedSet& whole, int number, const Tiles& tiles) {
  PlannedSet set = whole;
  set.name = fmt::format("{}.{}", whole.name, number);
  set.tile = number;
  Lacking lacking;
  std::erase_if(set.maps, [&](PlannedMap& map) {
    const auto files = tiles.find(map.path);
    if (files == tiles.end()) return false;
    const auto file = files->second.find(number);
    if (file == files->second.end()) {
      const std::string name = tile_name(map.path.string(), number);
      if (!map.if_present) lacking[name].emplace_back(slot_name(map.slot));
      return true;
    }
    map.path = file->second;
    return false;
  });
  if (lacking.empty()) return set;
  if (!is_shaded(set)) {
    set.fault = Error(Fault::Input, fmt::format("tile {} has no map that a BRDF reads, it lacks {}",
                                                number, told(lacking)));
  } else {
    set.warnings.push_back(
        fmt::format("tile {} lacks {}; constants are used instead", number, told(lacking)));
  }
  return set;
}

}  // namespace

std::vector<PlannedSet> tile_by_tile(std::vector<PlannedSet> sets) {
  std::vector<PlannedSet> all;
  for (PlannedSet& set : sets) {
    if (set.fault || !has_patterns(set)) {
      all.push_back(std::move(set));
      continue;
    }
    const Tiles tiles = tiles_of(set);
    const std::set<int> numbers = numbers_of(tiles);
    if (numbers.empty()) {
      set.fault = no_tiles(tiles);
      all.push_back(std::move(set));
      continue;
    }
    for (const int number : numbers) all.push_back(one_tile(set, number, tiles));
  }
  return all;
}

}  // namespace kiln

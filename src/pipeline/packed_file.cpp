// SPDX-License-Identifier: Apache-2.0
#include "packed_file.h"

#include <fmt/format.h>

#include <algorithm>

#include "kiln/bake/pack_layout.h"
#include "kiln/core/names.h"

namespace kiln {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view letters = "rgba";

const PackedFile& file_for(const std::string& stem, const std::vector<PackedFile>& files) {
  const PackedFile* found = files.size() == 1 ? &files.front() : nullptr;
  std::vector<std::string> names;
  for (const PackedFile& file : files) {
    names.push_back(file.suffix);
    const bool fits = kebab(stem).ends_with(kebab(file.suffix));
    if (fits && (!found || file.suffix.size() > found->suffix.size())) found = &file;
  }
  if (found) return *found;
  throw Error(Fault::Usage,
              fmt::format("packed: the name of '{}' ends in no file of the layout: {}", stem,
                          fmt::join(names, ", ")));
}

// "T_rock" of "T_rock_ORM", or the whole where nothing else is left.
std::string set_name(const std::string& stem, const std::string& suffix) {
  if (!kebab(stem).ends_with(kebab(suffix))) return stem;
  const std::string before = stem.substr(0, stem.size() - suffix.size());
  const size_t last = before.find_last_not_of("_-. ");
  return last == std::string::npos ? stem : before.substr(0, last + 1);
}

// One minus roughness is gloss; other numbers are turned as they are read, and green of normals is
// turned by its convention.
void invert(const PackSource& source, PlannedMap& map) {
  if (map.slot == Slot::Roughness) {
    map.slot = Slot::Gloss;
  } else if (slot_facts(map.slot).channels == 1) {
    map.decoding.scale = {-1, -1, -1};
    map.decoding.offset = {1, 1, 1};
  } else if (map.slot == Slot::Normal && source.channel == 1) {
    map.convention = map.convention == NormalConvention::OpenGl ? NormalConvention::DirectX
                                                                : NormalConvention::OpenGl;
  } else {
    throw Error(Fault::Usage, fmt::format("packed: found '{}', which nothing reads", source.text));
  }
}

// Channels of three-channel slots come in their order, or they are no colour and no vector.
void require_whole(const PlannedMap& map) {
  if (slot_facts(map.slot).channels == 1 || map.channels == "rgb") return;
  if (map.slot == Slot::Normal && map.channels == "rg") return;
  throw Error(Fault::Usage, fmt::format("packed: {} lies in '{}', expected 'rgb'",
                                        slot_name(map.slot), map.channels));
}

PlannedMap map_of(const PackSource& source, const fs::path& image, const std::string& file) {
  PlannedMap map;
  map.slot = source.slot;
  map.path = image;
  map.reason = fmt::format("{} of the layout's {}", source.text, file);
  if (map.slot == Slot::Normal) map.convention = source.convention;
  return map;
}

bool takes_next(const PlannedMap& map, const PackSource& source) {
  return map.slot == source.slot && map.channels.size() == static_cast<size_t>(source.channel) &&
         source.channel > 0;
}

std::vector<PlannedMap> maps_of(const PackedFile& file, const fs::path& image) {
  std::vector<PlannedMap> maps;
  for (size_t c = 0; c < file.channels.size(); ++c) {
    const PackSource& source = file.channels[c];
    if (source.is_constant) continue;
    if (maps.empty() || !takes_next(maps.back(), source)) {
      maps.push_back(map_of(source, image, file.suffix));
    }
    if (source.inverted) invert(source, maps.back());
    maps.back().channels += letters[c];
  }
  return maps;
}

}  // namespace

PlannedSet packed_set(const fs::path& image, const std::string& layout) {
  const std::string stem = image.stem().string();
  const std::vector<PackedFile> files = parse_layout(layout);
  const PackedFile& file = file_for(stem, files);
  PlannedSet set;
  set.name = set_name(stem, file.suffix);
  set.source = image.string();
  set.maps = maps_of(file, image);
  std::vector<Slot> given;
  for (const PlannedMap& map : set.maps) {
    require_whole(map);
    if (std::count(given.begin(), given.end(), map.slot)) {
      throw Error(Fault::Usage,
                  fmt::format("packed: {} holds {} twice", file.suffix, slot_name(map.slot)));
    }
    given.push_back(map.slot);
  }
  if (given.empty()) throw Error(Fault::Usage, fmt::format("packed: {} holds no map", file.suffix));
  const WorkflowGuess guess = guess_workflow(given);
  set.reading.workflow = guess.workflow;
  set.workflow_reason = guess.reason;
  return set;
}

}  // namespace kiln

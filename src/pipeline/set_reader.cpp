// SPDX-License-Identifier: Apache-2.0
#include "set_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "color_reading.h"
#include "kiln/material/slot_values.h"
#include "kiln/parallel/rows.h"
#include "map_colors.h"
#include "map_opening.h"
#include "normal_reading.h"

namespace kiln {
SetReader::SetReader(const PlannedSet& set, const ColorChoice& color, const ColorConfig& config,
                     const MapNeeds& needs)
    : set_(set), color_(color), config_(config) {
  if (set.fault) throw Error(*set.fault);
  record_.name = set.name;
  record_.workflow =
      fmt::format("{} ({})", workflow_name(set.reading.workflow), set.workflow_reason);
  record_.warnings = set.warnings;
  for (const IgnoredFile& file : set.ignored) {
    record_.notes.push_back(fmt::format("{} is not used: {}", file.file, file.reason));
  }
  const std::vector<PlannedMap> maps = maps_needed(set, needs);
  require_files(maps);
  for (const PlannedMap& map : maps) {
    if (map.slot == Slot::Normal && !map.path.empty()) bands_.normal = normal_form(set, map);
  }
  open(maps);
  decide_size(needs);
  bands_.name = set.name;
  bands_.working = color.working;
  bands_.wrap = settled(set.reading.wrap);
  bands_.alpha_cutoff = set.alpha_cutoff;
  bands_.stored = [this](const MapRows& rows) { return stored(rows); };
  bands_.linear = [this](const MapRows& rows) { return linear(rows); };
  bands_.svbrdf = [this](const MapRows& rows) { return svbrdf(rows); };
  bands_.whole = [this](Slot slot) { return whole_map(find(slot)->planned); };
}

void SetReader::open(const std::vector<PlannedMap>& maps) {
  for (const PlannedMap& map : maps) {
    if (map.path.empty()) {
      add_constant(map);
      continue;
    }
    const size_t file = file_of(map, maps);
    const FileFacts& facts = files_[file].windows.facts();
    if (map.if_present && !has_channels(facts.channels, map.channels)) continue;
    Map& added = maps_.emplace_back(Map{map, file});
    added.letters = slot_channels(facts.channels, map.slot, map.channels);
    added.names = picked_names(facts.channels, added.letters);
    const MapColor color = decide_color(map, facts, config_, color_);
    added.from = color.from;
    if (!color.warning.empty()) record_.warnings.push_back(color.warning);
    const bool is_color = !added.from.empty() && added.letters.size() != 2;
    if (is_color && facts.type == PixelType::Uint8) {
      added.codes = codes_to_working(added.from, map, config_, color_.working);
    }
    const std::string name = map.path.filename().string();
    bands_.given.push_back({map.slot, name, false, facts.size, static_cast<int>(added.names.size()),
                            std::string(pixel_type_name(facts.type)), added.from});
    record_.maps.push_back(
        {std::string(slot_name(map.slot)), name, map.channels, map.reason, color.text});
  }
}

void SetReader::add_constant(const PlannedMap& map) {
  SlotMap& constant = constants_[map.slot];
  constant.value = map.value;
  constant.encoding = map.encoding;
  constant.decoding = map.decoding;
  constant.source = "constant";
  const std::string color = constant_to_working(constant, map, config_, color_.working);
  bands_.given.push_back(
      {map.slot, "constant", true, {1, 1}, slot_facts(map.slot).channels, "", ""});
  record_.maps.push_back({std::string(slot_name(map.slot)), "constant", "", map.reason, color});
}

size_t SetReader::file_of(const PlannedMap& map, const std::vector<PlannedMap>& maps) {
  for (size_t i = 0; i < files_.size(); ++i) {
    if (files_[i].path == map.path) return i;
  }
  const FileFacts facts = facts_of_file(map);
  files_.push_back({map.path, FileWindows(rows_of(map, wanted_channels(map.path, facts, maps)))});
  for (const std::string& note : facts.notes) {
    record_.notes.push_back(fmt::format("{}: {}", map.path.filename().string(), note));
  }
  return files_.size() - 1;
}

SlotMap SetReader::head(const Map& map) const {
  SlotMap head = head_of(map.planned);
  head.image.size = files_[map.file].windows.facts().size;
  return head;
}

// Of resolved sets the maps that the workflow reads decide, of stored ones all.
void SetReader::decide_size(const MapNeeds& needs) {
  SlotMaps heads = constants_;
  for (const Map& map : maps_) heads[map.planned.slot] = head(map);
  if (needs.resolved) {
    add_unread(heads);
    resolver_.emplace(heads, set_.reading, bands_.normal);
    bands_.size = resolver_->size();
    return;
  }
  std::vector<Slot> slots;
  for (const auto& [slot, map] : heads) slots.push_back(slot);
  bands_.size = shared_size(heads, slots);
}

// Maps that were not opened are told of too.
void SetReader::add_unread(SlotMaps& heads) const {
  for (const PlannedMap& map : set_.maps) {
    const auto file = std::find_if(files_.begin(), files_.end(),
                                   [&](const File& other) { return other.path == map.path; });
    const bool may_lack =
        map.if_present &&
        (file == files_.end() || !has_channels(file->windows.facts().channels, map.channels));
    if (!may_lack) heads.try_emplace(map.slot, head_of(map));
  }
}

const SetReader::Map* SetReader::find(Slot slot) const {
  for (const Map& map : maps_) {
    if (map.planned.slot == slot) return &map;
  }
  return nullptr;
}

MapRows SetReader::next(int rows) {
  MapRows read;
  read.rows = {next_row_, rows};
  read.windows.resize(files_.size());
  for_rows(static_cast<int>(files_.size()), [&](int i) {
    const auto at = static_cast<size_t>(i);
    read.windows[at] = files_[at].windows.next(bands_.size.height, read.rows);
  });
  next_row_ += rows;
  return read;
}

Layers SetReader::picked(const Map& map, const MapRows& rows) const {
  const Layers& window = rows.windows[map.file].image;
  Layers picked{window.size, {}};
  for (size_t i = 0; i < map.names.size(); ++i) {
    const char letter = static_cast<char>(map.letters[i] - 'a' + 'A');
    picked.layers.push_back({std::string(1, letter), *window.find(map.names[i])});
  }
  return picked;
}

Layers SetReader::fitted(const Map& map, Layers image, const MapRows& rows) const {
  const Size size = files_[map.file].windows.facts().size;
  if (size == bands_.size) return image;
  const int first = rows.windows[map.file].first;
  Layers result{{bands_.size.width, rows.rows.count}, {}};
  for (const Layer& layer : image.layers) {
    result.layers.push_back(
        {layer.name, resample_rows(layer.plane, first, size.height, bands_.size, rows.rows)});
  }
  return result;
}

SlotMaps SetReader::stored(const MapRows& rows) const {
  SlotMaps stored = constants_;
  for (const Map& map : maps_) {
    SlotMap& filled = stored[map.planned.slot] = head(map);
    filled.image = picked(map, rows);
    if (!map.from.empty()) {
      scale_stored_colors(filled.image, map.from, map.planned, config_);
    } else if (map.planned.slot != Slot::AnisotropyAngle) {
      decode_slot(map.planned.slot, filled);
    }
    filled.image = fitted(map, std::move(filled.image), rows);
  }
  return stored;
}

Layers SetReader::working_colors(const Map& map, const MapRows& rows) const {
  Layers colors = as_rgb(picked(map, rows));
  if (map.codes) {
    look_up(*map.codes, colors);
  } else {
    colors_to_working(colors, map.from, map.planned, config_, color_.working);
  }
  return colors;
}

SlotMaps SetReader::linear(const MapRows& rows) const {
  SlotMaps linear;
  for (const Map& map : maps_) {
    if (map.from.empty()) continue;
    SlotMap& filled = linear[map.planned.slot] = head(map);
    filled.image = working_colors(map, rows);
    filled.image = fitted(map, std::move(filled.image), rows);
  }
  return linear;
}

Svbrdf SetReader::svbrdf(const MapRows& rows) const {
  SlotMaps read;
  for (const Slot slot : resolver_->read()) {
    const Map* map = find(slot);
    if (map == nullptr) continue;
    SlotMap& filled = read[slot] = head(*map);
    if (!map->from.empty()) {
      filled.image = working_colors(*map, rows);
    } else {
      filled.image = picked(*map, rows);
      decode_slot(slot, filled);
    }
    filled.image = fitted(*map, std::move(filled.image), rows);
  }
  Repairs repairs;
  Svbrdf svbrdf = resolver_->rows(std::move(read), repairs);
  svbrdf.name = set_.name;
  const std::lock_guard guard(repairs_guard_);
  repairs_.add(repairs);
  return svbrdf;
}

SetRecord SetReader::record() const {
  SetRecord record = record_;
  if (!resolver_) return record;
  for (const std::string& note : resolver_->notes(repairs_)) record.notes.push_back(note);
  for (const std::string& warning : resolver_->warnings(repairs_)) {
    record.warnings.push_back(warning);
  }
  return record;
}

}  // namespace kiln

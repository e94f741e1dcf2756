// SPDX-License-Identifier: Apache-2.0
#include "set_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "color_reading.h"
#include "kiln/material/slot_values.h"
#include "kiln/parallel/rows.h"

namespace kiln {
namespace {

namespace fs = std::filesystem;

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

/// Channels of a file that any of the maps takes: the others need not be unpacked.
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

ImageRows rows_of(const PlannedMap& map, const std::vector<std::string>& channels = {}) {
  return map.embedded.bytes ? ImageRows(map.embedded, channels) : ImageRows(map.path, channels);
}

Layers last_rows(const Layers& image, int count) {
  const int first = std::max(0, image.size.height - count);
  Layers rows{{image.size.width, image.size.height - first}, {}};
  for (const Layer& layer : image.layers) {
    Plane& plane = rows.add(layer.name);
    for (int y = first; y < image.size.height; ++y) {
      const auto row = layer.plane.texels_of_row(y);
      std::copy(row.begin(), row.end(), plane.row(y - first));
    }
  }
  return rows;
}

void put_above(const Layers& above, int from, Layers& image) {
  const int rows = above.size.height - from;
  Layers both{{image.size.width, image.size.height + rows}, {}};
  for (size_t c = 0; c < image.layers.size(); ++c) {
    Plane& plane = both.add(image.layers[c].name);
    for (int y = 0; y < both.size.height; ++y) {
      const auto row = y < rows ? above.layers[c].plane.texels_of_row(from + y)
                                : image.layers[c].plane.texels_of_row(y - rows);
      std::copy(row.begin(), row.end(), plane.row(y));
    }
  }
  image = std::move(both);
}

}  // namespace

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
  open(maps_needed(set, needs));
  decide_size(needs);
  bands_.name = set.name;
  bands_.working = color.working;
  bands_.wrap = settled(set.reading.wrap);
  bands_.alpha_cutoff = set.alpha_cutoff;
  bands_.stored = [this](const MapRows& rows) { return stored(rows); };
  bands_.linear = [this](const MapRows& rows) { return linear(rows); };
  bands_.svbrdf = [this](const MapRows& rows) { return svbrdf(rows); };
  bands_.whole = [this](Slot slot) {
    const Map& map = *find(slot);
    ImageRows rows = rows_of(map.planned);
    return pick_slot(rows.next(rows.facts().size.height), slot, map.planned.channels);
  };
}

std::vector<PlannedMap> maps_needed(const PlannedSet& set, const MapNeeds& needs) {
  std::vector<Slot> read = needs.stored, given;
  for (const PlannedMap& map : set.maps) given.push_back(map.slot);
  if (needs.resolved) {
    for (const Slot slot : slots_read(set.reading.workflow, given)) read.push_back(slot);
  }
  std::vector<PlannedMap> needed;
  for (const PlannedMap& map : set.maps) {
    if (needs.all || std::count(read.begin(), read.end(), map.slot)) needed.push_back(map);
  }
  return needed;
}

void SetReader::open(const std::vector<PlannedMap>& maps) {
  require_files(maps);
  for (const PlannedMap& map : maps) {
    if (map.path.empty()) {
      add_constant(map);
      continue;
    }
    const size_t file = file_of(map, maps);
    const FileFacts& facts = files_[file].rows.facts();
    if (map.if_present && !has_channels(facts.channels, map.channels)) continue;
    Map& added = maps_.emplace_back(Map{map, file});
    added.letters = slot_channels(facts.channels, map.slot, map.channels);
    added.names = picked_names(facts.channels, added.letters);
    const std::string color = decide_color(map, facts, added.from);
    const bool is_color = !added.from.empty() && added.letters.size() != 2;
    if (is_color && facts.type == PixelType::Uint8) {
      added.codes = codes_to_working(added.from, map, config_, color_.working);
    }
    const std::string name = map.path.filename().string();
    bands_.given.push_back({map.slot, name, false, facts.size, static_cast<int>(added.names.size()),
                            std::string(pixel_type_name(facts.type)), added.from});
    record_.maps.push_back(
        {std::string(slot_name(map.slot)), name, map.channels, map.reason, color});
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
  const fs::path& path = map.path;
  for (size_t i = 0; i < files_.size(); ++i) {
    if (files_[i].path == path) return i;
  }
  const FileFacts facts = map.embedded.bytes ? inspect_image(map.embedded) : inspect_image(path);
  files_.push_back({path, rows_of(map, wanted_channels(path, facts, maps)), 0, {}});
  for (const std::string& note : facts.notes) {
    record_.notes.push_back(fmt::format("{}: {}", path.filename().string(), note));
  }
  return files_.size() - 1;
}

std::string SetReader::decide_color(const PlannedMap& map, const FileFacts& facts,
                                    std::string& from) {
  if (slot_facts(map.slot).content == Content::Numbers) return "data";
  from = space_of(map.color_space, facts.type);
  if (map.color_space.empty()) compare_with_tag(map, facts, from);
  return conversion_text(from, color_.working);
}

// The file's own tag is a hint, not an order: files are tagged wrongly more often than not.
void SetReader::compare_with_tag(const PlannedMap& map, const FileFacts& facts,
                                 const std::string& from) {
  if (color_.on_conversion == ColorChoice::OnConversion::Allow || !facts.color_space_tag) return;
  const std::string tagged = known_space(*facts.color_space_tag);
  if (tagged.empty() || tagged == config_.resolve(from)) return;
  const std::string message = fmt::format("{}: tagged {}, read as {}; state its color_space",
                                          map.path.string(), *facts.color_space_tag, from);
  if (color_.on_conversion == ColorChoice::OnConversion::Refuse) {
    throw Error(Fault::Input, message);
  }
  record_.warnings.push_back(message);
}

// The config's name of a tag, or empty where the config does not know it.
std::string SetReader::known_space(const std::string& tag) const {
  const std::vector<std::string> spaces = config_.color_spaces();
  const auto found = std::find_if(spaces.begin(), spaces.end(), [&](const std::string& space) {
    return kebab(space) == kebab(tag);
  });
  return found == spaces.end() ? "" : *found;
}

SlotMap SetReader::head(const Map& map) const {
  SlotMap head;
  head.convention = map.planned.convention;
  head.encoding = map.planned.encoding;
  head.decoding = map.planned.decoding;
  head.source = map.planned.path.filename().string();
  head.image.size = files_[map.file].rows.facts().size;
  return head;
}

// Resolved sets are as large as the largest map that the workflow reads, stored ones as the largest
// of all.
void SetReader::decide_size(const MapNeeds& needs) {
  bands_.normal = survey_normals();
  SlotMaps heads = constants_;
  for (const Map& map : maps_) heads[map.planned.slot] = head(map);
  if (needs.resolved) {
    resolver_.emplace(heads, set_.reading, bands_.normal);
    bands_.size = resolver_->size();
    return;
  }
  bands_.size = {1, 1};
  for (const auto& [slot, map] : heads) {
    const Size size = map.image.size;
    if (std::pair(area(size), size) > std::pair(area(bands_.size), bands_.size)) {
      bands_.size = size;
    }
  }
}

const SetReader::Map* SetReader::find(Slot slot) const {
  for (const Map& map : maps_) {
    if (map.planned.slot == slot) return &map;
  }
  return nullptr;
}

// A height map is opened only where it alone can tell how the normals are meant.
std::optional<NormalForm> SetReader::survey_normals() const {
  const Map* normal = find(Slot::Normal);
  if (normal == nullptr) return std::nullopt;
  const bool convention_open = normal->planned.convention == NormalConvention::Auto &&
                               set_.reading.normal == NormalConvention::Auto;
  const auto planned = std::find_if(set_.maps.begin(), set_.maps.end(), [](const PlannedMap& map) {
    return map.slot == Slot::Height && !map.path.empty();
  });
  ImageRows normals = rows_of(normal->planned);
  const Size size = normals.facts().size;
  std::optional<Plane> height;
  if (convention_open && planned != set_.maps.end()) {
    ImageRows rows = rows_of(*planned);
    const Layers image = rows.next(rows.facts().size.height);
    height = resample(pick_slot(image, Slot::Height, planned->channels).layers[0].plane, size);
  }
  const PixelType type = normals.facts().type;
  NormalSurvey survey(head(*normal), set_.reading, height.has_value(),
                      type == PixelType::Half || type == PixelType::Float);
  const int band = static_cast<int>(
      std::clamp<long long>(NormalSurvey::enough_texels / size.width, 1, size.height));
  for (int first = 0; first < size.height; first += band) {
    const int rows = std::min(band, size.height - first);
    const Layers picked = pick_slot(normals.next(rows), Slot::Normal, normal->planned.channels);
    if (height) {
      const Plane beside = resample_rows(*height, 0, size.height, size, {first, rows});
      survey.add(picked, &beside);
    } else {
      survey.add(picked, nullptr);
    }
    if (!survey.is_open()) break;
  }
  return survey.form();
}

int SetReader::channels_read() const {
  int channels = 0;
  for (const File& file : files_) channels += static_cast<int>(file.rows.facts().channels.size());
  return channels;
}

MapRows SetReader::next(int rows) {
  MapRows read;
  read.rows = {next_row_, rows};
  read.windows.resize(files_.size());
  for_rows(static_cast<int>(files_.size()), [&](int i) {
    const auto at = static_cast<size_t>(i);
    read.windows[at] = read_window(files_[at], read.rows);
  });
  next_row_ += rows;
  return read;
}

MapRows::Window SetReader::read_window(File& file, RowRange rows) const {
  constexpr int most_shared = 2;  // rows that windows side by side have in common
  const int height = file.rows.facts().size.height;
  const RowRange needed = rows_read(height, bands_.size.height, rows);
  if (needed.first > file.next) file.rows.next(needed.first - file.next);
  const int first = std::max(needed.first, file.next);
  MapRows::Window window{needed.first, file.rows.next(needed.first + needed.count - first)};
  if (needed.first < file.next) {
    put_above(file.tail, file.tail.size.height - (file.next - needed.first), window.image);
  }
  file.next = needed.first + needed.count;
  if (height != bands_.size.height) file.tail = last_rows(window.image, most_shared);
  return window;
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
  const Size size = files_[map.file].rows.facts().size;
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

// SPDX-License-Identifier: Apache-2.0
#include "inputs.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "color_reading.h"
#include "kiln/io/image_file.h"
#include "map_colors.h"

namespace kiln {
namespace {

namespace fs = std::filesystem;

/// One set being loaded: each file is read once, however many slots share it.
class SetLoader {
 public:
  SetLoader(const PlannedSet& set, const ColorChoice& color, const ColorConfig& config)
      : set_(set), color_(color), config_(config) {
    record_.name = set.name;
    record_.workflow =
        fmt::format("{} ({})", workflow_name(set.reading.workflow), set.workflow_reason);
    record_.warnings = set.warnings;
    for (const IgnoredFile& file : set.ignored) {
      record_.notes.push_back(fmt::format("{} is not used: {}", file.file, file.reason));
    }
  }

  LoadedSet load() {
    const std::vector<PlannedMap> needed = needed_maps();
    require_files(needed);
    SlotMaps maps;
    for (const PlannedMap& map : needed) {
      if (map.path.empty()) {
        add_constant(map, maps);
      } else {
        add_file(map, maps);
      }
    }
    files_.clear();
    Resolved resolved = resolve(std::move(maps), set_.reading);
    resolved.svbrdf.name = set_.name;
    record_.notes.insert(record_.notes.end(), resolved.notes.begin(), resolved.notes.end());
    record_.warnings.insert(record_.warnings.end(), resolved.warnings.begin(),
                            resolved.warnings.end());
    return {std::move(resolved.svbrdf), std::move(record_)};
  }

 private:
  // Maps that nothing reads affect neither size nor outcome: they are not even opened. A height map
  // is, where only it can tell how the normals are meant.
  std::vector<PlannedMap> needed_maps() const {
    std::vector<Slot> given;
    bool convention_open = false;
    for (const PlannedMap& map : set_.maps) {
      given.push_back(map.slot);
      if (map.slot != Slot::Normal) continue;
      convention_open =
          map.convention == NormalConvention::Auto && set_.reading.normal == NormalConvention::Auto;
    }
    std::vector<Slot> read = slots_read(set_.reading.workflow, given);
    if (convention_open) read.push_back(Slot::Height);
    std::vector<PlannedMap> needed;
    for (const PlannedMap& map : set_.maps) {
      if (std::count(read.begin(), read.end(), map.slot)) needed.push_back(map);
    }
    return needed;
  }

  static void require_files(const std::vector<PlannedMap>& maps) {
    std::string missing;
    std::error_code failure;
    for (const PlannedMap& map : maps) {
      if (map.path.empty() || fs::exists(map.path, failure)) continue;
      missing += fmt::format("{}{} ({})", missing.empty() ? "" : ", ", map.path.string(),
                             slot_name(map.slot));
    }
    if (!missing.empty()) throw Error(Fault::Input, "no such file: " + missing);
  }

  void add_constant(const PlannedMap& map, SlotMaps& maps) {
    SlotMap filled;
    filled.value = map.value;
    filled.encoding = map.encoding;
    filled.decoding = map.decoding;
    filled.source = "constant";
    const std::string color = constant_to_working(filled, map, config_, color_.working);
    maps[map.slot] = std::move(filled);
    record_.maps.push_back({std::string(slot_name(map.slot)), "constant", "", map.reason, color});
  }

  void add_file(const PlannedMap& map, SlotMaps& maps) {
    const ImageFile& file = read(map.path);
    if (map.if_present && !has_channels(file.facts.channels, map.channels)) return;
    const std::string name = map.path.filename().string();
    SlotMap filled;
    filled.image = with_context(map.path.string(),
                                [&] { return pick_slot(file.image, map.slot, map.channels); });
    filled.convention = map.convention;
    filled.encoding = map.encoding;
    filled.decoding = map.decoding;
    filled.source = name;
    const std::string color = bring_to_working(map, file.facts, filled.image);
    if (slot_facts(map.slot).content == Content::Color) filled.decoding = {};
    maps[map.slot] = std::move(filled);
    record_.maps.push_back(
        {std::string(slot_name(map.slot)), name, map.channels, map.reason, color});
  }

  const ImageFile& read(const fs::path& path) {
    const auto found = files_.find(path);
    if (found != files_.end()) return found->second;
    const ImageFile& file = files_[path] = read_image(path);
    for (const std::string& note : file.facts.notes) {
      record_.notes.push_back(fmt::format("{}: {}", path.filename().string(), note));
    }
    return file;
  }

  std::string bring_to_working(const PlannedMap& map, const FileFacts& facts, Layers& image) {
    if (slot_facts(map.slot).content == Content::Numbers) return "data";
    image = as_rgb(std::move(image));
    const std::string from = space_of(map.color_space, facts.type);
    if (map.color_space.empty()) compare_with_tag(map, facts, from);
    colors_to_working(image, from, map, config_, color_.working);
    return conversion_text(from, color_.working);
  }

  // The file's own tag is a hint, not an order: files are tagged wrongly more often than not.
  void compare_with_tag(const PlannedMap& map, const FileFacts& facts, const std::string& from) {
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
  std::string known_space(const std::string& tag) const {
    const std::vector<std::string> spaces = config_.color_spaces();
    const auto found = std::find_if(spaces.begin(), spaces.end(), [&](const std::string& space) {
      return kebab(space) == kebab(tag);
    });
    return found == spaces.end() ? "" : *found;
  }

  const PlannedSet& set_;
  const ColorChoice& color_;
  const ColorConfig& config_;
  std::map<fs::path, ImageFile> files_;
  SetRecord record_;
};

}  // namespace

LoadedSet load_set(const PlannedSet& set, const ColorChoice& color, const ColorConfig& config) {
  if (set.fault) throw Error(*set.fault);
  return SetLoader(set, color, config).load();
}

}  // namespace kiln

// SPDX-License-Identifier: Apache-2.0
#include "material_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "kiln/io/image_file.h"
#include "kiln/pipeline/report.h"

namespace kiln {
namespace {

namespace fs = std::filesystem;

// As YAML and JSON both read it, whatever is in it.
std::string quoted(const std::string& text) { return nlohmann::json(text).dump(); }

std::string numbers_text(const std::array<float, 3>& v) {
  return v[0] == v[1] && v[1] == v[2] ? fmt::format("{}", v[0])
                                      : fmt::format("[{}, {}, {}]", v[0], v[1], v[2]);
}

/// A block on one line: "{ path: ..., channel: g }".
class Line {
 public:
  void add(std::string_view key, std::string_view text) {
    text_ += fmt::format("{}{}: {}", text_.empty() ? "{ " : ", ", key, text);
  }
  std::string text() const { return text_ + " }"; }

 private:
  std::string text_;
};

template <class Names, class Word>
std::string word(const Names& names, Word word) {
  return std::string(names[static_cast<size_t>(word)]);
}

std::string encoding_of(const PlannedMap& map) {
  switch (map.slot) {
    case Slot::Roughness:
      return word(roughness_encoding_names, map.decoding.roughness);
    case Slot::SpecularLevel:
      return word(specular_encoding_names, map.encoding);
    case Slot::Anisotropy:
      return word(anisotropy_encoding_names, map.decoding.anisotropy);
    case Slot::AnisotropyAngle:
      return word(angle_encoding_names, map.decoding.angle);
    default:
      return "";
  }
}

void add_decoding(const PlannedMap& map, Line& line) {
  if (const std::string encoding = encoding_of(map); !encoding.empty()) {
    line.add("encoding", encoding);
  }
  if (map.decoding.scale != SlotDecoding{}.scale) {
    line.add("scale", numbers_text(map.decoding.scale));
  }
  if (map.decoding.offset != SlotDecoding{}.offset) {
    line.add("offset", numbers_text(map.decoding.offset));
  }
  if (!map.color_space.empty()) line.add("color_space", quoted(map.color_space));
}

// A map of the set, as it was planned.
std::string line_of(const PlannedMap& map, const MapBands& bands, const fs::path& folder) {
  Line line;
  if (map.path.empty()) {
    line.add("value", numbers_text(*map.value));
  } else {
    line.add("path", quoted(fs::proximate(map.path, folder).generic_string()));
    line.add("channel", map.channels);
  }
  if (map.slot == Slot::Normal && bands.normal) {
    line.add("convention", word(normal_convention_names, bands.normal->decoding.convention));
  }
  add_decoding(map, line);
  return line.text();
}

std::string line_of(const Artifact& artifact, Slot slot, const std::string& file) {
  Line line;
  line.add("path", quoted(file));
  PlannedMap map;  // numbers are as their slots have them by default
  map.slot = slot;
  map.color_space = artifact.color_to;
  add_decoding(map, line);
  return line.text();
}

bool is_in(const std::vector<Slot>& slots, Slot slot) {
  return std::count(slots.begin(), slots.end(), slot) > 0;
}

bool is_there(const PlannedMap& map) {
  return !map.if_present || has_channels(inspect_image(map.path).channels, map.channels);
}

// Of the set's reading, what is not the default.
std::string reading_text(const PlannedSet& set) {
  const WorkflowSettings& reading = set.reading;
  std::string text;
  if (set.alpha_cutoff) text += fmt::format("alpha_cutoff: {}\n", *set.alpha_cutoff);
  if (reading.normal_zero != NormalZero::Both) {
    text += fmt::format("normal_zero: {}\n", word(normal_zero_names, reading.normal_zero));
  }
  if (reading.normal_range != NormalRange::Auto) {
    text += fmt::format("normal_range: {}\n", word(normal_range_names, reading.normal_range));
  }
  if (reading.wrap != WrapChoice::Auto) {
    text += fmt::format("wrap: {}\n", word(wrap_choice_names, reading.wrap));
  }
  return text;
}

}  // namespace

MaterialText material_text(const MapSheet& sheet, const std::vector<std::string>& files,
                           const PlannedSet& set, const MapBands& bands, const fs::path& folder) {
  const SheetMaterial& material = *sheet.material;
  MaterialText result;
  result.text = fmt::format("# {}\nversion: 1\nname: {}\nworkflow: {}\n{}maps:\n", software(),
                            quoted(set.name), workflow_name(material.workflow), reading_text(set));
  for (size_t i = 0; i < files.size(); ++i) {
    result.text += fmt::format("  {}: {}\n", slot_name(material.slots[i]),
                               line_of(sheet.files[i], material.slots[i], files[i]));
  }
  for (const PlannedMap& map : set.maps) {
    if (is_in(material.replaced, map.slot)) continue;
    if (map.embedded.bytes) {
      result.notes.push_back(
          fmt::format("material.yaml leaves out {}: it lies inside {}; unpack makes a file of it",
                      slot_name(map.slot), set.source));
    } else if (is_there(map)) {
      result.text += fmt::format("  {}: {}\n", slot_name(map.slot), line_of(map, bands, folder));
    }
  }
  return result;
}

}  // namespace kiln

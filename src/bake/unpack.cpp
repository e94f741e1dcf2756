// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "bakes.h"
#include "map_files.h"
#include "word_list.h"

namespace kiln {
namespace {

using Settings = UnpackBake::Settings;

std::vector<std::string> slot_words() {
  std::vector<std::string> words{"all"};
  for (const SlotFacts& facts : slot_list) words.emplace_back(facts.name);
  return words;
}

std::vector<Slot> slots_of(const Settings& settings) {
  std::vector<Slot> slots;
  for (const std::string& word : word_list("maps", settings.maps, slot_words())) {
    if (word == "all") return every_slot();
    slots.push_back(parse_slot(word));
  }
  return slots;
}

std::string extension_of(const Settings& settings, const GivenMap& map) {
  if (!settings.format.empty()) return "." + settings.format;
  return map.stored_type == "uint8" || map.stored_type == "uint16" ? ".png" : ".exr";
}

Artifact file_of(const Settings& settings, const GivenMap& map) {
  Artifact file = map_file(std::string(slot_name(map.slot)), extension_of(settings, map),
                           channel_names(static_cast<size_t>(map.channels)));
  file.preferred_type = map.stored_type;
  file.color_from = file.color_to = map.color_space;
  return file;
}

}  // namespace

Params<Settings> UnpackBake::params() {
  return {
      text_param("maps", &Settings::maps, "which, by their slots: roughness,metallic"),
      choice_param("format", &Settings::format, map_formats(), "of the files; by the maps' own")};
}

Needs UnpackBake::needs(const Settings& settings) {
  return {.maps = {.stored = slots_of(settings)}};
}

Baked UnpackBake::bake(const Settings& settings, const Ingredients& ingredients) {
  const MapBands& maps = *ingredients.maps;
  Baked baked;
  MapSheet& sheet = baked.sheet.emplace();
  std::vector<Slot> slots;
  for (const GivenMap& map : maps.given) {
    if (map.is_constant) continue;
    slots.push_back(map.slot);
    sheet.files.push_back(file_of(settings, map));
  }
  if (slots.empty()) throw Error(Fault::Input, "none of the maps that are to be unpacked is given");
  sheet.make = [&maps, slots](const MapRows& rows) {
    SlotMaps stored = maps.stored(rows);
    std::vector<Layers> made;
    for (const Slot slot : slots) {
      Layers& image = made.emplace_back(std::move(stored.at(slot).image));
      if (image.layers.size() == 1) image.layers.front().name = "Y";
    }
    return made;
  };
  return baked;
}

}  // namespace kiln

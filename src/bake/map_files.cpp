// SPDX-License-Identifier: Apache-2.0
#include "map_files.h"

#include <algorithm>
#include <array>
#include <utility>

namespace kiln {
namespace {

constexpr std::array types{"uint8", "uint16", "half", "float"};

size_t rank_of(const std::string& type) {
  return static_cast<size_t>(std::find(types.begin(), types.end(), type) - types.begin());
}

bool is_integer(const GivenMap& map) { return map.is_constant || rank_of(map.stored_type) < 2; }

}  // namespace

const std::vector<std::string>& map_formats() {
  static const std::vector<std::string> formats{"exr", "png", "tif", "dds", "ktx2"};
  return formats;
}

std::string map_extension(const std::string& format, const MapBands& maps) {
  if (!format.empty()) return "." + format;
  return std::all_of(maps.given.begin(), maps.given.end(), is_integer) ? ".png" : ".exr";
}

std::string widest_type(const std::vector<const GivenMap*>& maps) {
  size_t widest = 0;
  for (const GivenMap* map : maps) {
    if (!map->is_constant)
      widest = std::max(widest, std::min(rank_of(map->stored_type), types.size() - 1));
  }
  return types[widest];
}

std::vector<std::string> channel_names(size_t count) {
  if (count == 1) return {"Y"};
  std::vector<std::string> names{"R", "G", "B", "A"};
  names.resize(count);
  return names;
}

std::vector<Slot> every_slot() {
  std::vector<Slot> slots;
  slots.reserve(slot_list.size());
  for (const SlotFacts& facts : slot_list) slots.push_back(facts.slot);
  return slots;
}

Artifact map_file(const std::string& name, const std::string& extension,
                  const std::vector<std::string>& channels) {
  Artifact file;
  file.name = name;
  file.extension = extension;
  file.image = make_layers({}, channels);
  file.attributes = {{"kiln:quantity", name}};
  return file;
}

Artifact color_file(const std::string& name, const std::string& extension, const MapBands& maps) {
  Artifact file = map_file(name, extension, {"R", "G", "B"});
  file.color_from = maps.working;
  const bool integers = extension == ".png" || extension == ".jpg";
  file.color_to = integers ? "srgb_rec709_scene" : maps.working;
  return file;
}

Layers layers_of(std::vector<Plane> planes, const std::vector<std::string>& names) {
  Layers image{planes.front().size(), {}};
  for (size_t i = 0; i < planes.size(); ++i)
    image.layers.push_back({names[i], std::move(planes[i])});
  return image;
}

}  // namespace kiln

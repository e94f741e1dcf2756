// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <map>
#include <set>

#include "bakes.h"
#include "kiln/bake/pack_layout.h"
#include "map_files.h"
#include "stored_rows.h"

namespace kiln {
namespace {

using Settings = PackBake::Settings;

std::vector<PackedFile> files_of(const Settings& settings) {
  return parse_layout(settings.layout.empty() ? find_pack_preset(settings.preset).layout
                                              : settings.layout);
}

/// A packed file with the maps that its channels come from, null where a constant stands in.
struct Packed {
  PackedFile file;
  std::vector<const GivenMap*> maps;

  bool any_map() const {
    return std::any_of(maps.begin(), maps.end(), [](const GivenMap* map) { return map; });
  }
  // Alone, or three that are one colour.
  const GivenMap* color() const {
    const bool one = maps.size() >= 3 && maps[0] && maps[0] == maps[1] && maps[0] == maps[2];
    return one && !maps[0]->color_space.empty() ? maps[0] : nullptr;
  }
};

std::vector<Packed> packed_by(const Settings& settings, const MapBands& maps, Baked& baked) {
  std::vector<Packed> packed;
  for (PackedFile& file : files_of(settings)) {
    Packed one{std::move(file), {}};
    for (const PackSource& source : one.file.channels) {
      one.maps.push_back(source.is_constant ? nullptr : standing_for(maps, source.slot));
    }
    if (!one.any_map()) {
      baked.notes.push_back(
          fmt::format("{}: not made, none of its maps is given", one.file.suffix));
      continue;
    }
    for (size_t c = 0; c < one.maps.size(); ++c) {
      const PackSource& source = one.file.channels[c];
      if (source.is_constant || one.maps[c]) continue;
      const float constant = slot_facts(source.slot).missing[static_cast<size_t>(source.channel)];
      baked.notes.push_back(fmt::format("{}.{}: no map for {}, constant {}", one.file.suffix,
                                        "rgba"[c], source.text,
                                        source.inverted ? 1 - constant : constant));
    }
    packed.push_back(std::move(one));
  }
  return packed;
}

Artifact artifact_of(const Packed& packed, const std::string& extension) {
  Artifact file =
      map_file(packed.file.suffix, extension, channel_names(packed.file.channels.size()));
  std::vector<const GivenMap*> given;
  for (const GivenMap* map : packed.maps) {
    if (map) given.push_back(map);
  }
  file.preferred_type = widest_type(given);
  file.attributes.emplace_back("kiln:channels", sources_text(packed.file));
  if (const GivenMap* color = packed.color()) {
    file.color_from = color->color_space;
    file.color_to = extension == ".png" ? "srgb_rec709_scene" : color->color_space;
  }
  return file;
}

Layers packed_rows(const Packed& packed, const SlotMaps& rows, const MapBands& maps, Size size) {
  std::vector<Plane> planes;
  std::map<NormalConvention, Layers> normals;
  for (size_t c = 0; c < packed.maps.size(); ++c) {
    const PackSource& source = packed.file.channels[c];
    if (source.is_constant) {
      planes.emplace_back(size, source.constant);
      continue;
    }
    const bool is_normal = source.slot == Slot::Normal && packed.maps[c] && maps.normal;
    if (is_normal) {
      Layers& normal = normals[source.convention];
      if (normal.layers.empty()) {
        normal = stored_normals(rows.at(Slot::Normal), *maps.normal, source.convention);
      }
      planes.push_back(normal.layers[static_cast<size_t>(source.channel)].plane);
    } else {
      planes.push_back(stored_channel(rows, packed.maps[c], source.slot, source.channel, size));
    }
    if (source.inverted) invert(planes.back());
  }
  return layers_of(std::move(planes), channel_names(packed.maps.size()));
}

}  // namespace

Params<Settings> PackBake::params() {
  return {
      choice_param("preset", &Settings::preset, pack_preset_names(), "layout of an engine"),
      text_param("layout", &Settings::layout,
                 "instead of it: \"orm = ambient_occlusion, roughness, metallic\", or a file of "
                 "layouts and #NAME"),
      choice_param("format", &Settings::format, map_formats(), "of the files; by the maps' own")};
}

Needs PackBake::needs(const Settings& settings) {
  std::set<Slot> slots;
  for (const PackedFile& file : files_of(settings)) {
    for (const PackSource& source : file.channels) {
      if (!source.is_constant) slots.insert({source.slot, stand_in(source.slot)});
    }
  }
  return {.maps = {.stored = {slots.begin(), slots.end()}}};
}

Baked PackBake::bake(const Settings& settings, const Ingredients& ingredients) {
  const MapBands& maps = *ingredients.maps;
  Baked baked;
  const std::vector<Packed> packed = packed_by(settings, maps, baked);
  if (packed.empty()) throw Error(Fault::Input, "none of the maps that the layout packs is given");
  const std::string extension = map_extension(settings.format, maps);
  MapSheet& sheet = baked.sheet.emplace();
  for (const Packed& one : packed) sheet.files.push_back(artifact_of(one, extension));
  sheet.make = [&maps, packed](const MapRows& rows) {
    const SlotMaps stored = maps.stored(rows);
    const Size size{maps.size.width, rows.rows.count};
    std::vector<Layers> made;
    made.reserve(packed.size());
    for (const Packed& one : packed) {
      made.push_back(packed_rows(one, stored, maps, size));
    }
    return made;
  };
  return baked;
}

}  // namespace kiln

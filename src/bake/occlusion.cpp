// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <memory>

#include "bakes.h"
#include "horizon_scan.h"
#include "map_files.h"

namespace kiln {
namespace {

using Settings = OcclusionBake::Settings;

const GivenMap& height_of(const MapBands& maps) {
  const GivenMap* map = maps.find(Slot::Height);
  if (map != nullptr && !map->is_constant) return *map;
  throw Error(Fault::Input, "the set has no height map");
}

HorizonScan scan_of(const Settings& settings, const MapBands& maps) {
  Layers height = maps.whole(Slot::Height);
  const double texel = settings.tile_size / height.size.width;
  return HorizonScan(height.layers.front().plane,
                     {settings.height_scale / texel, settings.radius / texel, settings.directions});
}

}  // namespace

Params<Settings> OcclusionBake::params() {
  return {
      number_param("height_scale", &Settings::height_scale, {0, 1e6}, "[m]",
                   "between black and white of the height map"),
      number_param("tile_size", &Settings::tile_size, {1e-6, 1e6}, "[m]", "width of the map"),
      number_param("radius", &Settings::radius, {1e-9, 1e6}, "[m]", "how far relief occludes"),
      integer_param("directions", &Settings::directions, {2, 256},
                    "azimuths that are looked along, an even number"),
      choice_param("format", &Settings::format, map_formats(), "of the file; by the map's own")};
}

Needs OcclusionBake::needs(const Settings& settings) {
  if (settings.directions % 2 != 0) {
    throw Error(Fault::Usage, "directions: found an odd number, expected an even one");
  }
  // The map, and the same with borders that it repeats.
  const double border = std::min(settings.radius / settings.tile_size, 1.0);
  return {.maps = {.stored = {Slot::Height}, .held = 2 + 2 * border}};
}

Baked OcclusionBake::bake(const Settings& settings, const Ingredients& ingredients) {
  const MapBands& maps = *ingredients.maps;
  const GivenMap& map = height_of(maps);
  const auto scan = std::make_shared<const HorizonScan>(scan_of(settings, maps));
  Baked baked;
  MapSheet& sheet = baked.sheet.emplace();
  sheet.files.push_back(map_file("ambient_occlusion", map_extension(settings.format, maps), {"Y"}));
  sheet.files.back().preferred_type = map.stored_type == "uint8" ? "uint8" : "uint16";
  sheet.make = [scan](const MapRows& rows) {
    Plane visible({scan->size().width, rows.rows.count});
    for (int y = 0; y < rows.rows.count; ++y) scan->visibility(rows.rows.first + y, visible.row(y));
    std::vector<Plane> planes;
    planes.push_back(std::move(visible));
    return std::vector<Layers>{layers_of(std::move(planes), {"Y"})};
  };
  return baked;
}

}  // namespace kiln

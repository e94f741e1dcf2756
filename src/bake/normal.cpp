// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <memory>

#include "bakes.h"
#include "map_files.h"
#include "stored_rows.h"

namespace kiln {
namespace {

using Settings = NormalBake::Settings;

NormalConvention convention_of(const Settings& settings) {
  return settings.to == NormalBake::To::OpenGl ? NormalConvention::OpenGl
                                               : NormalConvention::DirectX;
}

/// A height map that repeats, in units in which its gradient is the slope.
struct Relief {
  Plane height;
  float per_texel_x, per_texel_y;  ///< [1/texel] of half a difference over two texels

  // Central differences; rows and columns go on at the other side.
  std::array<Plane, 3> normals(RowRange rows) const {
    const int width = height.width();
    std::array<Plane, 3> normal = {Plane({width, rows.count}), Plane({width, rows.count}),
                                   Plane({width, rows.count})};
    for (int y = 0; y < rows.count; ++y) {
      const int at = rows.first + y, count = height.height();
      const float* above = height.row((at + count - 1) % count);
      const float* here = height.row(at);
      const float* below = height.row((at + 1) % count);
      for (int x = 0; x < width; ++x) {
        const float east = here[x + 1 < width ? x + 1 : 0], west = here[x > 0 ? x - 1 : width - 1];
        const float nx = (west - east) * per_texel_x, ny = (below[x] - above[x]) * per_texel_y;
        const float inverse = 1.0f / std::sqrt(nx * nx + ny * ny + 1.0f);
        normal[0].at(x, y) = nx * inverse;
        normal[1].at(x, y) = ny * inverse;
        normal[2].at(x, y) = inverse;
      }
    }
    return normal;
  }
};

Relief relief_of(const Settings& settings, const MapBands& maps) {
  Layers height = maps.whole(Slot::Height);
  const Size size = height.size;
  const double tall = settings.tile_size * size.height / size.width;
  const auto per_texel = [&](double meters, int texels) {
    return static_cast<float>(0.5 * settings.height_scale * texels / meters);
  };
  return {std::move(height.layers.front().plane), per_texel(settings.tile_size, size.width),
          per_texel(tall, size.height)};
}

void drop_blue(Layers& image) { image.layers.resize(2); }

const GivenMap& required(const MapBands& maps, Slot slot) {
  const GivenMap* map = maps.find(slot);
  if (map != nullptr && !map->is_constant) return *map;
  throw Error(Fault::Input, "the set has no " + std::string(slot_name(slot)) + " map");
}

}  // namespace

Params<Settings> NormalBake::params() {
  return {
      word_param("from", &Settings::from, {"normal", "height"}, "map that it is made of"),
      word_param("to", &Settings::to, {"gl", "dx"}, "green points up, or down"),
      flag_param("two_channel", &Settings::two_channel, "red and green alone"),
      flag_param("renormalize", &Settings::renormalize, "make every normal of unit length"),
      number_param("height_scale", &Settings::height_scale, {0, 1e6}, "[m]",
                   "between black and white of the height map"),
      number_param("tile_size", &Settings::tile_size, {1e-6, 1e6}, "[m]", "width of the map"),
      choice_param("format", &Settings::format, map_formats(), "of the file; by the map's own")};
}

Needs NormalBake::needs(const Settings& settings) {
  if (settings.from == From::Normal) return {.maps = {.stored = {Slot::Normal}}};
  return {.maps = {.stored = {Slot::Height}, .held = 1}};
}

Baked NormalBake::bake(const Settings& settings, const Ingredients& ingredients) {
  const MapBands& maps = *ingredients.maps;
  const bool from_height = settings.from == From::Height;
  const GivenMap& map = required(maps, from_height ? Slot::Height : Slot::Normal);
  const NormalConvention convention = convention_of(settings);
  Baked baked;
  MapSheet& sheet = baked.sheet.emplace();
  sheet.files.push_back(map_file(convention == NormalConvention::OpenGl ? "normal_gl" : "normal_dx",
                                 map_extension(settings.format, maps),
                                 settings.two_channel ? std::vector<std::string>{"R", "G"}
                                                      : std::vector<std::string>{"R", "G", "B"}));
  sheet.files.back().preferred_type = from_height ? "uint16" : map.stored_type;
  std::function<Layers(const MapRows&)> make;
  if (from_height) {
    const auto relief = std::make_shared<const Relief>(relief_of(settings, maps));
    make = [relief, convention](const MapRows& rows) {
      return encoded_normals(relief->normals(rows.rows), convention);
    };
  } else {
    if (maps.normal) baked.notes = maps.normal->notes;
    make = [&maps, settings, convention](const MapRows& rows) {
      const SlotMap stored = maps.stored(rows).at(Slot::Normal);
      if (!settings.renormalize) return stored_normals(stored, *maps.normal, convention);
      return encoded_normals(decode_normals(stored.image, maps.normal->decoding).normal,
                             convention);
    };
  }
  sheet.make = [make, two = settings.two_channel](const MapRows& rows) {
    std::vector<Layers> made{make(rows)};
    if (two) drop_blue(made.front());
    return made;
  };
  return baked;
}

}  // namespace kiln

// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "bakes.h"
#include "map_files.h"
#include "metalness.h"
#include "stored_rows.h"

namespace kiln {
namespace {

using Settings = ConvertBake::Settings;

/// A map of the target workflow.
struct Target {
  const char* name;  ///< the slot's, as in a material file
  bool is_color;
};

std::vector<Target> targets_of(const Settings& settings) {
  switch (settings.to) {
    case Workflow::SpecGloss:
      return {{"diffuse", true}, {"specular_color", true}, {"gloss", false}};
    case Workflow::AlbedoSpecularRoughness:
      return {{"diffuse", true}, {"specular_color", true}, {"roughness", false}};
    case Workflow::MetalRough:
      break;
  }
  if (settings.method == ConvertBake::Method::Lossless) {
    return {
        {"base_color", true}, {"metallic", false}, {"specular_color", true}, {"roughness", false}};
  }
  return {{"base_color", true}, {"metallic", false}, {"roughness", false}};
}

Plane gloss_of(Plane roughness) {
  invert(roughness);
  return roughness;
}

/// The base colour and metalness of each texel.
struct Metallic {
  std::array<Plane, 3> base;
  Plane metallic;
};

Metallic metallic_of(const Svbrdf& rows, ConvertBake::Method method) {
  Metallic result{{Plane(rows.size), Plane(rows.size), Plane(rows.size)}, Plane(rows.size)};
  const auto solve =
      method == ConvertBake::Method::Khronos ? khronos_metalness<float> : exact_metalness<float>;
  const auto color = [](const std::array<Plane, 3>& planes, int x, int y) {
    return Vec3<float>{planes[0].at(x, y), planes[1].at(x, y), planes[2].at(x, y)};
  };
  for (int y = 0; y < rows.size.height; ++y) {
    for (int x = 0; x < rows.size.width; ++x) {
      const MetalRough<float> found = solve(color(rows.diffuse_color, x, y), color(rows.f0, x, y));
      result.base[0].at(x, y) = found.base.x;
      result.base[1].at(x, y) = found.base.y;
      result.base[2].at(x, y) = found.base.z;
      result.metallic.at(x, y) = found.metallic;
    }
  }
  return result;
}

Layers rgb(const std::array<Plane, 3>& planes) {
  return layers_of({planes.begin(), planes.end()}, {"R", "G", "B"});
}
Layers grey(Plane plane) { return layers_of({std::move(plane)}, {"Y"}); }

std::vector<Layers> converted(const Settings& settings, const Svbrdf& rows) {
  switch (settings.to) {
    case Workflow::SpecGloss:
      return {rgb(rows.diffuse_color), rgb(rows.f0), grey(gloss_of(rows.roughness))};
    case Workflow::AlbedoSpecularRoughness:
      return {rgb(rows.diffuse_color), rgb(rows.f0), grey(rows.roughness)};
    case Workflow::MetalRough:
      break;
  }
  if (settings.method == ConvertBake::Method::Lossless) {
    return {rgb(rows.diffuse_color), grey(Plane(rows.size)), rgb(rows.f0), grey(rows.roughness)};
  }
  const Metallic metallic = metallic_of(rows, settings.method);
  return {rgb(metallic.base), grey(metallic.metallic), grey(rows.roughness)};
}

const std::vector<std::string> method_words = {"solve", "lossless", "khronos"};

}  // namespace

Params<Settings> ConvertBake::params() {
  return {
      word_param("to", &Settings::to, {workflow_names.begin(), workflow_names.end()},
                 "workflow to convert to"),
      word_param("method", &Settings::method, method_words,
                 "to metal-rough: solve for metalness, keep F0 as a map, or KhronosGroup's"),
      choice_param("format", &Settings::format, map_formats(), "of the files; by the maps' own")};
}

Needs ConvertBake::needs(const Settings&) { return {.maps = {.resolved = true}}; }

Baked ConvertBake::bake(const Settings& settings, const Ingredients& ingredients) {
  const MapBands& maps = *ingredients.maps;
  const std::string extension = map_extension(settings.format, maps);
  std::vector<const GivenMap*> given;
  for (const GivenMap& map : maps.given) given.push_back(&map);
  Baked baked;
  MapSheet& sheet = baked.sheet.emplace();
  for (const Target& target : targets_of(settings)) {
    sheet.files.push_back(target.is_color ? color_file(target.name, extension, maps)
                                          : map_file(target.name, extension, {"Y"}));
    sheet.files.back().preferred_type = widest_type(given);
  }
  sheet.make = [&maps, settings](const MapRows& rows) {
    return converted(settings, maps.svbrdf(rows));
  };
  if (settings.to == Workflow::MetalRough && settings.method == Method::Lossless) {
    baked.notes.emplace_back(
        "lossless: metallic is 0 and specular_color is F0, as KHR_materials_specular with ior 0 "
        "has it; read back as albedo-specular-roughness");
  }
  return baked;
}

}  // namespace kiln

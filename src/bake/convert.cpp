// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "bakes.h"
#include "map_files.h"
#include "metalness.h"
#include "stored_rows.h"

namespace kiln {
namespace {

using Settings = ConvertBake::Settings;

bool is_lossless_metal(const Settings& settings) {
  return settings.to == Workflow::MetalRough && settings.method == ConvertBake::Method::Lossless;
}

// Maps of the target workflow.
std::vector<Slot> slots_made(const Settings& settings) {
  switch (settings.to) {
    case Workflow::SpecGloss:
      return {Slot::Diffuse, Slot::SpecularColor, Slot::Gloss};
    case Workflow::AlbedoSpecularRoughness:
      return {Slot::Diffuse, Slot::SpecularColor, Slot::Roughness};
    case Workflow::MetalRough:
      break;
  }
  if (is_lossless_metal(settings)) {
    return {Slot::BaseColor, Slot::Metallic, Slot::SpecularColor, Slot::Roughness};
  }
  return {Slot::BaseColor, Slot::Metallic, Slot::Roughness};
}

// With metallic 0 base colour and F0 are what a workflow without metals reads.
SheetMaterial material_of(const Settings& settings, std::vector<Slot> slots) {
  const Workflow workflow =
      is_lossless_metal(settings) ? Workflow::AlbedoSpecularRoughness : settings.to;
  return {workflow,
          std::move(slots),
          {Slot::BaseColor, Slot::Diffuse, Slot::Roughness, Slot::Gloss, Slot::Metallic,
           Slot::SpecularColor, Slot::SpecularLevel, Slot::SpecularTint, Slot::SpecularWeight,
           Slot::Anisotropy}};
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
  if (is_lossless_metal(settings)) {
    return {rgb(rows.diffuse_color), grey(Plane(rows.size)), rgb(rows.f0), grey(rows.roughness)};
  }
  const Metallic metallic = metallic_of(rows, settings.method);
  return {rgb(metallic.base), grey(metallic.metallic), grey(rows.roughness)};
}

Artifact file_of(Slot slot, const std::string& extension, const MapBands& maps) {
  const std::string name(slot_name(slot));
  std::vector<const GivenMap*> given;
  for (const GivenMap& map : maps.given) given.push_back(&map);
  Artifact file = slot_facts(slot).content == Content::Color ? color_file(name, extension, maps)
                                                             : map_file(name, extension, {"Y"});
  file.preferred_type = widest_type(given);
  return file;
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

Needs ConvertBake::needs(const Settings& settings) {
  int planes = 1;  // of anisotropy, which may be there
  for (const Slot slot : slots_made(settings)) planes += slot_facts(slot).channels;
  return {.maps = {.resolved = true, .made = planes}};
}

Baked ConvertBake::bake(const Settings& settings, const Ingredients& ingredients) {
  const MapBands& maps = *ingredients.maps;
  const std::string extension = map_extension(settings.format, maps);
  std::vector<Slot> slots = slots_made(settings);
  const bool is_anisotropic = maps.find(Slot::Anisotropy) != nullptr;
  if (is_anisotropic) slots.push_back(Slot::Anisotropy);
  Baked baked;
  MapSheet& sheet = baked.sheet.emplace();
  for (const Slot slot : slots) sheet.files.push_back(file_of(slot, extension, maps));
  sheet.material = material_of(settings, std::move(slots));
  sheet.make = [&maps, settings, is_anisotropic](const MapRows& rows) {
    const Svbrdf svbrdf = maps.svbrdf(rows);
    std::vector<Layers> made = converted(settings, svbrdf);
    if (is_anisotropic) made.push_back(grey(svbrdf.anisotropy));
    return made;
  };
  if (is_lossless_metal(settings)) {
    baked.notes.emplace_back(
        "lossless: metallic is 0 and specular_color is F0, as KHR_materials_specular with ior 0 "
        "has it; read back as albedo-specular-roughness");
  }
  return baked;
}

}  // namespace kiln

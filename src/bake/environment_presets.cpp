// SPDX-License-Identifier: Apache-2.0
#include "environment_presets.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "kiln/bake/environment.h"
#include "kiln/core/find_named.h"
#include "kiln/light/chain_plan.h"

namespace kiln {

const std::vector<EnvironmentFormat>& all_environment_formats() {
  static const std::vector<EnvironmentFormat> formats{
      {"exr", ".exr", "OpenEXR, a file per level and face", false, false, {"float", "half"}},
      {"exr-mip",
       ".exr",
       "OpenEXR, one tiled mip-mapped file with the `envmap` attribute",
       true,
       true,
       {"half", "float"}},
      {"hdr", ".hdr", "Radiance HDR, a file per level and face", false, false, {"rgbe"}},
      {"ktx2", ".ktx2", "KTX 2", true, false, {"half", "float", "b10g11r11", "e5b9g9r9"}, true},
      {"ktx1",
       ".ktx",
       "KTX 1, as Filament loads it",
       true,
       false,
       {"b10g11r11", "half", "float", "e5b9g9r9"}},
      {"dds",
       ".dds",
       "DDS with the header of DirectX 10",
       true,
       false,
       {"half", "float", "b10g11r11", "e5b9g9r9"}},
      {"env",
       ".env",
       "Babylon.js environment: cubes of 2^n, levels down to 1",
       true,
       false,
       {"rgbd8"}},
  };
  return formats;
}

const std::vector<EnvironmentPreset>& all_environment_presets() {
  static const std::vector<EnvironmentPreset> presets{
      {"filament",
       "Filament: KTX 1 with harmonics, as cmgen --deploy writes it",
       {{"format", "ktx1"}, {"encoding", "b10g11r11"}, {"curve", "filament"}},
       "ibl",
       "irradiance",
       "skybox",
       {"b10g11r11 rounds by up to 0.8 % (blue 1.6 %) and holds no radiance above 65024; use "
        "--encoding half or float for suns",
        "cmgen loses some energy and windows its harmonics; these are exact: --sh-window for "
        "suns"}},
      {"three",
       "three.js: KTX 2 cube in half floats, roughness as its PMREM",
       {{"format", "ktx2"}, {"encoding", "half"}, {"curve", "filament"}},
       "specular",
       "irradiance",
       "",
       {"PMREMGenerator filters what it is given once more; take level 0 for it"}},
      {"babylon",
       "Babylon.js: .env with its irradiance polynomial",
       {{"format", "env"}, {"curve", "babylon"}},
       "environment",
       "irradiance",
       "",
       {"rgbd8 holds no radiance above 255"}},
      {"gltf",
       "Khronos glTF sample viewer: KTX 2 cubes in half floats",
       {{"format", "ktx2"}, {"encoding", "half"}, {"curve", "linear"}},
       "specular",
       "diffuse",
       "",
       {}},
      {"unity",
       "Unity: DDS cube in half floats, seven levels",
       {{"format", "dds"}, {"encoding", "half"}, {"curve", "unity"}, {"axes", "-x,y,z"}},
       "specular",
       "irradiance",
       "",
       {"Unity is left-handed: its +X is kiln's -X"}},
      {"unreal",
       "Unreal: DDS cube in half floats",
       {{"format", "dds"}, {"encoding", "half"}, {"curve", "filament"}, {"axes", "z,-x,y"}},
       "specular",
       "irradiance",
       "",
       {"Unreal looks along +X with +Z up, left-handed: its x, y, z are kiln's +Z, -X, +Y",
        "Unreal filters what it imports itself; its own roughness curve was not verified"}},
      {"godot",
       "Godot: lat-long OpenEXR, a file per level",
       {{"format", "exr"}, {"encoding", "half"}, {"layout", "latlong"}, {"curve", "linear"}},
       "specular",
       "irradiance",
       "",
       {"Godot filters a panorama itself: load level 0; the others serve as reference"}},
  };
  return presets;
}

std::vector<std::string> environment_preset_names() {
  std::vector<std::string> names;
  for (const EnvironmentPreset& preset : all_environment_presets()) names.push_back(preset.name);
  return names;
}

const EnvironmentFormat& find_environment_format(const std::string& name) {
  return find_named(all_environment_formats(), "format", name);
}

const EnvironmentPreset& find_environment_preset(const std::string& name) {
  return find_named(all_environment_presets(), "preset", name);
}

std::vector<NamedText> list_roughness_curves() {
  std::vector<NamedText> curves;
  for (const RoughnessCurve& curve : all_roughness_curves()) {
    curves.push_back({curve.name, curve.meaning, {{"source", curve.source}}});
  }
  return curves;
}

std::vector<NamedText> list_environment_presets() {
  std::vector<NamedText> presets;
  for (const EnvironmentPreset& preset : all_environment_presets()) {
    NamedText item{preset.name, preset.summary, {}};
    for (const auto& [key, text] : preset.settings) item.facts.emplace_back(key, text);
    item.facts.emplace_back("files", preset.specular + ", " + preset.irradiance +
                                         (preset.skybox.empty() ? "" : ", " + preset.skybox));
    for (const std::string& caution : preset.cautions) item.facts.emplace_back("note", caution);
    presets.push_back(std::move(item));
  }
  return presets;
}

std::vector<NamedText> list_environment_formats() {
  std::vector<NamedText> formats;
  for (const EnvironmentFormat& format : all_environment_formats()) {
    formats.push_back({format.name,
                       format.meaning,
                       {{"extension", format.extension},
                        {"encodings", fmt::format("{}", fmt::join(format.encodings, ", "))}}});
  }
  return formats;
}

}  // namespace kiln

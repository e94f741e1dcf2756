// SPDX-License-Identifier: Apache-2.0
#include "kiln/bake/pack_layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "kiln/core/error.h"
#include "kiln/core/find_named.h"
#include "kiln/core/names.h"

namespace kiln {
namespace {

std::string trimmed(const std::string& text) {
  const size_t begin = text.find_first_not_of(" \t\r\n");
  if (begin == std::string::npos) return "";
  return text.substr(begin, text.find_last_not_of(" \t\r\n") - begin + 1);
}

std::vector<std::string> split(const std::string& text, char at) {
  std::vector<std::string> parts;
  for (size_t begin = 0; begin <= text.size();) {
    const size_t end = std::min(text.find(at, begin), text.size());
    parts.push_back(trimmed(text.substr(begin, end - begin)));
    begin = end + 1;
  }
  return parts;
}

bool read_number(const std::string& text, float& number) {
  const auto read = std::from_chars(text.data(), text.data() + text.size(), number);
  return read.ec == std::errc() && read.ptr == text.data() + text.size();
}

PackSource constant_source(const std::string& text, float value) {
  if (!(value >= 0 && value <= 1)) {
    throw Error(Fault::Usage, fmt::format("layout: found the constant {}, expected [0, 1]", text));
  }
  PackSource source;
  source.is_constant = true;
  source.constant = value;
  source.text = text;
  return source;
}

// "smoothness" is 1 - roughness, whichever of the two is given.
PackSource map_source(const std::string& text, bool inverted) {
  const size_t dot = text.find('.');
  PackSource source;
  source.text = fmt::format("{}{}", inverted ? "1 - " : "", text);
  source.inverted = inverted;
  std::string name = snake(text.substr(0, dot));
  if (name == "normal_gl" || name == "normal_dx") {
    if (name == "normal_dx") source.convention = NormalConvention::DirectX;
    name = "normal";
  }
  source.slot = parse_slot(name);
  if (source.slot == Slot::Gloss) {
    source.slot = Slot::Roughness;
    source.inverted = !inverted;
  }
  if (dot == std::string::npos) return source;
  const std::string letter = text.substr(dot + 1);
  const size_t place =
      letter.size() == 1 ? std::string_view("rgb").find(letter[0]) : std::string_view::npos;
  if (place == std::string_view::npos) {
    throw Error(Fault::Usage, fmt::format("layout: found '{}', expected .r, .g or .b", text));
  }
  source.channel = static_cast<int>(place);
  return source;
}

std::vector<PackSource> parse_sources(const std::string& text) {
  float number = 0;
  if (read_number(text, number)) return {constant_source(text, number)};
  const bool inverted = text.starts_with("1 -") || text.starts_with("1-");
  const std::string map = inverted ? trimmed(text.substr(text.find('-') + 1)) : text;
  const PackSource source = map_source(map, inverted);
  if (map.find('.') != std::string::npos || slot_facts(source.slot).channels == 1) return {source};
  std::vector<PackSource> all(3, source);
  for (int c = 0; c < 3; ++c) all[static_cast<size_t>(c)].channel = c;
  return all;
}

}  // namespace

std::vector<PackedFile> parse_layout(const std::string& text) {
  std::vector<PackedFile> files;
  for (const std::string& part : split(text, ';')) {
    if (part.empty()) continue;
    const size_t equals = part.find('=');
    if (equals == std::string::npos) {
      throw Error(Fault::Usage,
                  fmt::format("layout: found '{}', expected NAME = SOURCE, SOURCE, ...", part));
    }
    PackedFile file{trimmed(part.substr(0, equals)), {}};
    for (const std::string& word : split(part.substr(equals + 1), ',')) {
      for (PackSource& source : parse_sources(word)) file.channels.push_back(std::move(source));
    }
    if (file.channels.size() > 4) {
      throw Error(Fault::Usage, fmt::format("layout: '{}' has {} channels, expected at most 4",
                                            file.suffix, file.channels.size()));
    }
    files.push_back(std::move(file));
  }
  if (files.empty()) throw Error(Fault::Usage, "layout: found no file");
  return files;
}

std::string sources_text(const PackedFile& file) {
  std::string text;
  for (const PackSource& source : file.channels) {
    const bool is_told = source.channel > 0 && source.text.find('.') == std::string::npos;
    if (!is_told) text += (text.empty() ? "" : ", ") + source.text;
  }
  return text;
}

// THE list of presets.
const std::vector<PackPreset>& all_pack_presets() {
  static const std::vector<PackPreset> presets = {
      {"gltf", "glTF 2.0: occlusion, roughness and metallic in one file",
       "baseColor = base_color; metallicRoughness = ambient_occlusion, roughness, metallic; "
       "normal = normal; emissive = emissive"},
      {"unreal", "Unreal Engine: ORM, normals point down (DirectX)",
       "BC = base_color; ORM = ambient_occlusion, roughness, metallic; N = normal_dx; "
       "E = emissive"},
      {"godot", "Godot's ORMMaterial3D",
       "albedo = base_color; orm = ambient_occlusion, roughness, metallic; normal = normal; "
       "emission = emissive"},
      {"unity-hdrp", "Unity HDRP: mask map with smoothness in alpha",
       "BaseMap = base_color; MaskMap = metallic, ambient_occlusion, 0.5, smoothness; "
       "Normal = normal; Emissive = emissive"},
      {"unity-urp", "Unity URP: metallic, occlusion and smoothness",
       "BaseMap = base_color; MetallicOcclusionSmoothness = metallic, ambient_occlusion, 0, "
       "smoothness; Normal = normal; Emission = emissive"},
      {"khr-spec-gloss", "KHR_materials_pbrSpecularGlossiness: specular with gloss in alpha",
       "diffuse = diffuse; specularGlossiness = specular_color, gloss; normal = normal; "
       "occlusion = ambient_occlusion; emissive = emissive"},
      {"polyhaven", "Poly Haven's names: arm and its neighbours",
       "diff = base_color; arm = ambient_occlusion, roughness, metallic; nor_gl = normal; "
       "disp = height"}};
  return presets;
}

std::vector<std::string> pack_preset_names() {
  std::vector<std::string> names;
  for (const PackPreset& preset : all_pack_presets()) names.push_back(preset.name);
  return names;
}

const PackPreset& find_pack_preset(const std::string& name) {
  return find_named(all_pack_presets(), "preset", name);
}

std::vector<NamedText> list_pack_presets() {
  std::vector<NamedText> list;
  for (const PackPreset& preset : all_pack_presets()) {
    NamedText& text = list.emplace_back(NamedText{preset.name, preset.summary, {}});
    for (const PackedFile& file : parse_layout(preset.layout)) {
      text.facts.emplace_back(file.suffix, sources_text(file));
    }
  }
  return list;
}

}  // namespace kiln

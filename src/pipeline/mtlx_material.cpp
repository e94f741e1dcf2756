// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "document_formats.h"
#include "mtlx_file.h"

namespace kiln {
namespace {

using Value = std::array<float, 3>;

/// An input of a shader and the slot that it fills.
struct ShaderInput {
  std::string name;
  Slot slot;
  std::optional<Value> missing;  ///< the shader's default; nothing: the slot stays empty
  std::string weight = {};       ///< an input that it is multiplied by
  float weight_missing = 1;
};

/// THE table of shaders.
struct Shader {
  std::string category;
  std::vector<ShaderInput> inputs;
  SlotDecoding anisotropy = {}, angle = {};
};

constexpr Value grey(float v) { return {v, v, v}; }

// Standard surface: 1 - aspect^2 = anisotropy, where Burley's is 0.9 of it; its rotation in turns.
Shader standard_surface() {
  return {"standard_surface",
          {{"base_color", Slot::BaseColor, grey(0.8f), "base", 1},
           {"metalness", Slot::Metallic, grey(0)},
           {"specular_roughness", Slot::Roughness, grey(0.2f)},
           {"specular", Slot::SpecularWeight, grey(1)},
           {"specular_color", Slot::SpecularTint, grey(1)},
           {"specular_IOR", Slot::SpecularLevel, grey(1.5f)},
           {"specular_anisotropy", Slot::Anisotropy, {}},
           {"specular_rotation", Slot::AnisotropyAngle, {}},
           {"normal", Slot::Normal, {}},
           {"opacity", Slot::Opacity, {}},
           {"emission_color", Slot::Emissive, grey(1), "emission", 0}},
          {.scale = grey(1 / 0.9f)},
          {}};
}

Shader open_pbr_surface() {
  return {"open_pbr_surface",
          {{"base_color", Slot::BaseColor, grey(0.8f), "base_weight", 1},
           {"base_metalness", Slot::Metallic, grey(0)},
           {"specular_roughness", Slot::Roughness, grey(0.3f)},
           {"specular_weight", Slot::SpecularWeight, grey(1)},
           {"specular_color", Slot::SpecularTint, grey(1)},
           {"specular_ior", Slot::SpecularLevel, grey(1.5f)},
           {"specular_roughness_anisotropy", Slot::Anisotropy, {}},
           {"geometry_normal", Slot::Normal, {}},
           {"geometry_opacity", Slot::Opacity, {}},
           {"emission_color", Slot::Emissive, grey(1), "emission_luminance", 0}},
          {.anisotropy = AnisotropyEncoding::OpenPbr},
          {}};
}

Shader gltf_pbr() {
  return {"gltf_pbr",
          {{"base_color", Slot::BaseColor, grey(1)},
           {"metallic", Slot::Metallic, grey(1)},
           {"roughness", Slot::Roughness, grey(1)},
           {"specular", Slot::SpecularWeight, grey(1)},
           {"specular_color", Slot::SpecularTint, grey(1)},
           {"ior", Slot::SpecularLevel, grey(1.5f)},
           {"anisotropy_strength", Slot::Anisotropy, {}},
           {"anisotropy_rotation", Slot::AnisotropyAngle, {}},
           {"normal", Slot::Normal, {}},
           {"occlusion", Slot::AmbientOcclusion, {}},
           {"alpha", Slot::Opacity, {}},
           {"emissive", Slot::Emissive, {}, "emissive_strength", 1}},
          {.anisotropy = AnisotropyEncoding::Gltf},
          {.angle = AngleEncoding::Radians}};
}

const Shader* shader_of(pugi::xml_node node) {
  static const std::array<Shader, 3> shaders = {standard_surface(), open_pbr_surface(), gltf_pbr()};
  for (const Shader& shader : shaders) {
    if (shader.category == node.name()) return &shader;
  }
  return nullptr;
}

class MtlxMaterial {
 public:
  MtlxMaterial(const MtlxFile& file, pugi::xml_node node, const Shader& shader)
      : file_(file), node_(node), shader_(shader) {}

  DocumentMaterial read(const std::string& name) {
    result_.set.name = name;
    result_.set.reading.workflow = Workflow::MetalRough;
    result_.set.workflow_reason = "as " + shader_.category + " has it";
    for (const ShaderInput& input : shader_.inputs) read_input(input);
    note_unread();
    return std::move(result_);
  }

 private:
  void read_input(const ShaderInput& input) {
    const pugi::xml_node given = MtlxFile::input_of(node_, input.name);
    const float weight = weight_of(input);
    if (input.slot == Slot::Emissive && weight == 0) return;
    if (!given && !input.missing) return;
    PlannedMap map;
    map.slot = input.slot;
    if (given) {
      fill(file_.source_of(given), map);
      map.reason = input.name;
    } else {
      if (map.slot == Slot::SpecularLevel) map.encoding = SpecularEncoding::Ior;
      map.value = input.missing;
      map.reason = input.name + " by default";
      if (slot_facts(map.slot).content == Content::Color) map.color_space = "lin_rec709_scene";
    }
    if (weight != 1) {
      for (float& factor : map.decoding.scale) factor *= weight;
    }
    if (is_geometric_normal(map)) return;
    result_.set.maps.push_back(std::move(map));
  }

  // A constant normal is the geometry's own.
  static bool is_geometric_normal(const PlannedMap& map) {
    return map.slot == Slot::Normal && map.path.empty();
  }

  float weight_of(const ShaderInput& input) const {
    if (input.weight.empty()) return 1;
    const pugi::xml_node given = MtlxFile::input_of(node_, input.weight);
    if (!given) return input.weight_missing;
    const MtlxSource source = file_.source_of(given);
    if (!source.path.empty()) {
      file_.refuse(given, fmt::format("{} is an image; it is read as a constant", input.weight));
    }
    return source.value[0];
  }

  void fill(const MtlxSource& source, PlannedMap& map) {
    const SlotFacts& facts = slot_facts(map.slot);
    if (map.slot == Slot::SpecularLevel) map.encoding = SpecularEncoding::Ior;
    if (map.slot == Slot::Anisotropy) map.decoding = shader_.anisotropy;
    if (map.slot == Slot::AnisotropyAngle) map.decoding = shader_.angle;
    if (facts.content == Content::Color) map.color_space = source.color_space;
    if (source.path.empty()) {
      map.value = source.value;
      if (facts.content == Content::Color && map.color_space.empty()) {
        map.color_space = "lin_rec709_scene";
      }
      return;
    }
    map.path = source.path;
    map.channels = facts.channels == 1 ? source.channels.substr(0, 1) : source.channels;
    if (map.slot == Slot::Normal) {
      map.convention = NormalConvention::OpenGl;
      map.decoding.scale = {source.normal_scale, source.normal_scale, 1};
    }
    if (!result_.wrap) result_.wrap = source.wrap;
  }

  // Inputs that are stated and fill no slot.
  void note_unread() {
    for (const pugi::xml_node input : node_.children("input")) {
      const std::string name = input.attribute("name").value();
      const bool known = std::any_of(
          shader_.inputs.begin(), shader_.inputs.end(),
          [&](const ShaderInput& read) { return read.name == name || read.weight == name; });
      if (!known) result_.set.ignored.push_back({name, "this input is not rendered"});
    }
  }

  const MtlxFile& file_;
  pugi::xml_node node_;
  const Shader& shader_;
  DocumentMaterial result_;
};

DocumentMaterial material_of(const MtlxFile& file, pugi::xml_node shader, const std::string& name) {
  const Shader* known = shader_of(shader);
  if (!known) {
    file.refuse(shader, fmt::format("material '{}' is a {}; standard_surface, open_pbr_surface and "
                                    "gltf_pbr are read",
                                    name, shader.name()));
  }
  return MtlxMaterial(file, shader, *known).read(name);
}

}  // namespace

std::vector<DocumentMaterial> mtlx_materials(const std::filesystem::path& path) {
  const MtlxFile file(path);
  std::vector<DocumentMaterial> materials;
  for (const pugi::xml_node node : file.root().children("surfacematerial")) {
    const pugi::xml_node input = MtlxFile::input_of(node, "surfaceshader");
    const std::string name = node.attribute("name").value();
    if (!input) file.refuse(node, fmt::format("material '{}' has no surfaceshader", name));
    materials.push_back(material_of(file, file.node_of(input), name));
  }
  if (!materials.empty()) return materials;
  for (const pugi::xml_node node : file.root().children()) {
    if (shader_of(node)) {
      materials.push_back(material_of(file, node, node.attribute("name").value()));
    }
  }
  return materials;
}

}  // namespace kiln

// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "document_formats.h"
#include "gltf_file.h"
#include "gltf_transform.h"

namespace kiln {
namespace {

constexpr const char* encoded = "srgb_rec709_scene";
constexpr const char* linear = "lin_rec709_scene";

using Factor = std::array<float, 3>;
Factor grey(double value) {
  const auto v = static_cast<float>(value);
  return {v, v, v};
}

/// One material on its way to what fills its slots.
class GltfMaterial {
 public:
  GltfMaterial(GltfFile& file, const JsonAt& material) : file_(file), material_(material) {}

  DocumentMaterial read() {
    result_.set.name = material_.text("name");
    const auto gloss = extension("KHR_materials_pbrSpecularGlossiness");
    result_.set.reading.workflow = gloss ? Workflow::SpecGloss : Workflow::MetalRough;
    result_.set.workflow_reason = gloss ? "KHR_materials_pbrSpecularGlossiness" : "as glTF has it";
    if (gloss) {
      read_specular_glossiness(*gloss);
    } else {
      read_metallic_roughness();
      read_dielectric();
    }
    read_anisotropy();
    read_surface();
    read_emission();
    note_unread();
    if (wraps_.size() == 1) result_.wrap = wraps_.front();
    if (wraps_.size() > 1) warn("its textures wrap in different ways, repeat is used");
    note_placings();
    return std::move(result_);
  }

 private:
  std::optional<JsonAt> extension(const std::string& name) const {
    const auto extensions = material_.find("extensions");
    return extensions ? extensions->find(name) : std::nullopt;
  }

  void warn(const std::string& text) { result_.set.warnings.push_back(text); }

  PlannedMap& add(Slot slot, const std::string& reason) {
    PlannedMap& map = result_.set.maps.emplace_back();
    map.slot = slot;
    map.reason = reason;
    return map;
  }

  // A constant; colours are linear.
  PlannedMap& add_value(Slot slot, const Factor& value, const std::string& reason) {
    PlannedMap& map = add(slot, reason);
    map.value = value;
    if (slot_facts(slot).content == Content::Color) map.color_space = linear;
    return map;
  }

  PlannedMap& add_texture(Slot slot, const JsonAt& use, const std::string& channels,
                          const Factor& factor) {
    const auto index = use.index("index");
    const std::vector<JsonAt> textures = file_.root().items("textures");
    if (!index) use.refuse("`index` is missing");
    if (*index >= textures.size()) {
      use.refuse(fmt::format("index is {}, there are {} textures", *index, textures.size()));
    }
    const GltfFile::Image image = file_.image_of(textures[*index]);
    note_use(use, textures[*index]);
    PlannedMap& map = add(slot, use.where());
    map.path = image.path;
    map.embedded = image.embedded;
    map.channels = channels;
    map.decoding.scale = factor;
    if (slot_facts(slot).content == Content::Color) map.color_space = encoded;
    return map;
  }

  // A texture times a factor, or the factor alone.
  PlannedMap& add_product(Slot slot, const std::optional<JsonAt>& texture,
                          const std::string& channels, const Factor& factor,
                          const std::string& factor_name) {
    if (texture) return add_texture(slot, *texture, channels, factor);
    return add_value(slot, factor, factor_name);
  }

  void note_use(const JsonAt& use, const JsonAt& texture) {
    const Wrap wrap = wrap_of(texture);
    if (!std::count(wraps_.begin(), wraps_.end(), wrap)) wraps_.push_back(wrap);
    const std::string& where = use.where();
    if (std::count(uses_.begin(), uses_.end(), where)) return;
    uses_.push_back(where);
    placings_.add(where.substr(where.rfind('.') + 1), placing_of(use, wrap));
  }

  void note_placings() {
    if (const std::string difference = placings_.difference(); !difference.empty()) {
      warn("its textures lie differently on the mesh (" + difference +
           "), but are read texel by texel as if they lay alike");
    } else if (const std::string common = placings_.common(); !common.empty()) {
      result_.set.ignored.push_back(
          {"KHR_texture_transform",
           common + " of all its textures alike: it places what is baked as it did these"});
    }
  }

  Wrap wrap_of(const JsonAt& texture) const {
    const auto index = texture.index("sampler");
    if (!index) return Wrap::Repeat;
    const std::vector<JsonAt> samplers = file_.root().items("samplers");
    if (*index >= samplers.size()) {
      texture.refuse(fmt::format("sampler is {}, there are {}", *index, samplers.size()));
    }
    constexpr int clamp_to_edge = 33071, mirrored_repeat = 33648;
    const auto mode = static_cast<int>(samplers[*index].number("wrapS", 10497));
    if (mode == clamp_to_edge) return Wrap::Clamp;
    return mode == mirrored_repeat ? Wrap::Mirror : Wrap::Repeat;
  }

  void read_metallic_roughness() {
    static const Json nothing = Json::object();
    const auto found = material_.find("pbrMetallicRoughness");
    const JsonAt pbr = found ? *found : JsonAt(nothing, file_.path().string());
    const auto base = pbr.numbers<4>("baseColorFactor", {1, 1, 1, 1});
    add_product(Slot::BaseColor, pbr.find("baseColorTexture"), "rgb", {base[0], base[1], base[2]},
                "baseColorFactor");
    add_opacity(pbr.find("baseColorTexture"), base[3]);
    const auto packed = pbr.find("metallicRoughnessTexture");
    add_product(Slot::Roughness, packed, "g", grey(pbr.number("roughnessFactor", 1)),
                "roughnessFactor");
    add_product(Slot::Metallic, packed, "b", grey(pbr.number("metallicFactor", 1)),
                "metallicFactor");
  }

  void read_specular_glossiness(const JsonAt& pbr) {
    const auto diffuse = pbr.numbers<4>("diffuseFactor", {1, 1, 1, 1});
    add_product(Slot::Diffuse, pbr.find("diffuseTexture"), "rgb",
                {diffuse[0], diffuse[1], diffuse[2]}, "diffuseFactor");
    add_opacity(pbr.find("diffuseTexture"), diffuse[3]);
    const auto packed = pbr.find("specularGlossinessTexture");
    add_product(Slot::SpecularColor, packed, "rgb", pbr.numbers<3>("specularFactor", {1, 1, 1}),
                "specularFactor");
    add_product(Slot::Gloss, packed, "a", grey(pbr.number("glossinessFactor", 1)),
                "glossinessFactor");
  }

  // F0 = min(((ior - 1) / (ior + 1))^2 specularColor, 1) specular.
  void read_dielectric() {
    const auto ior = extension("KHR_materials_ior");
    const double index = ior ? ior->number("ior", 1.5) : 1.5;
    PlannedMap& level = add_value(Slot::SpecularLevel, grey(index > 0 ? index : 1),
                                  ior ? "KHR_materials_ior" : "index of refraction 1.5");
    level.encoding = index > 0 ? SpecularEncoding::Ior : SpecularEncoding::F0;
    const auto specular = extension("KHR_materials_specular");
    if (!specular) return;
    add_product(Slot::SpecularWeight, specular->find("specularTexture"), "a",
                grey(specular->number("specularFactor", 1)), "specularFactor");
    add_product(Slot::SpecularTint, specular->find("specularColorTexture"), "rgb",
                specular->numbers<3>("specularColorFactor", {1, 1, 1}), "specularColorFactor");
  }

  void read_anisotropy() {
    const auto anisotropy = extension("KHR_materials_anisotropy");
    if (!anisotropy) return;
    const double strength = anisotropy->number("anisotropyStrength", 0);
    const double rotation = anisotropy->number("anisotropyRotation", 0);
    const auto texture = anisotropy->find("anisotropyTexture");
    add_product(Slot::Anisotropy, texture, "b", grey(strength), "anisotropyStrength")
        .decoding.anisotropy = AnisotropyEncoding::Gltf;
    if (texture) {
      PlannedMap& angle = add_texture(Slot::AnisotropyAngle, *texture, "rg", {1, 1, 1});
      angle.decoding.angle = AngleEncoding::Direction;
      angle.decoding.offset = grey(rotation);
    } else {
      add_value(Slot::AnisotropyAngle, grey(rotation), "anisotropyRotation").decoding.angle =
          AngleEncoding::Radians;
    }
  }

  void read_surface() {
    if (const auto normal = material_.find("normalTexture")) {
      const auto scale = static_cast<float>(normal->number("scale", 1));
      add_texture(Slot::Normal, *normal, "rgb", {scale, scale, 1}).convention =
          NormalConvention::OpenGl;
    }
    if (const auto occlusion = material_.find("occlusionTexture")) {
      const double strength = occlusion->number("strength", 1);
      add_texture(Slot::AmbientOcclusion, *occlusion, "r", grey(strength)).decoding.offset =
          grey(1 - strength);
    }
  }

  void read_emission() {
    Factor factor = material_.numbers<3>("emissiveFactor", {0, 0, 0});
    if (const auto strength = extension("KHR_materials_emissive_strength")) {
      for (float& f : factor) f *= static_cast<float>(strength->number("emissiveStrength", 1));
    }
    const auto texture = material_.find("emissiveTexture");
    if (texture || factor != Factor{0, 0, 0}) {
      add_product(Slot::Emissive, texture, "rgb", factor, "emissiveFactor");
    }
  }

  // What alphaMode makes of the alpha of the base colour.
  void add_opacity(const std::optional<JsonAt>& texture, float factor) {
    const std::string mode = material_.text("alphaMode", "OPAQUE");
    if (mode == "OPAQUE") return;
    if (mode != "MASK" && mode != "BLEND") {
      material_.refuse(fmt::format("alphaMode is '{}', expected OPAQUE, MASK or BLEND", mode));
    }
    if (mode == "MASK") {
      result_.set.alpha_cutoff = material_.number("alphaCutoff", 0.5);
    }
    if (texture) {
      add_texture(Slot::Opacity, *texture, "a", grey(factor)).if_present = true;
    } else {
      add_value(Slot::Opacity, grey(factor), "alpha of the colour's factor");
    }
  }

  void note_unread() {
    static const std::vector<std::string> read = {
        "KHR_materials_specular", "KHR_materials_ior", "KHR_materials_pbrSpecularGlossiness",
        "KHR_materials_anisotropy", "KHR_materials_emissive_strength"};
    const auto extensions = material_.find("extensions");
    if (!extensions) return;
    for (const std::string& name : extensions->keys()) {
      if (!std::count(read.begin(), read.end(), name)) {
        result_.set.ignored.push_back({name, "this extension is not rendered"});
      }
    }
  }

  GltfFile& file_;
  const JsonAt& material_;
  DocumentMaterial result_;
  std::vector<Wrap> wraps_;
  std::vector<std::string> uses_;
  TexturePlacings placings_;
};

}  // namespace

std::vector<DocumentMaterial> gltf_materials(const std::filesystem::path& path) {
  GltfFile file(path);
  std::vector<DocumentMaterial> materials;
  for (const JsonAt& material : file.root().items("materials")) {
    materials.push_back(GltfMaterial(file, material).read());
  }
  return materials;
}

}  // namespace kiln

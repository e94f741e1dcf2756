// SPDX-License-Identifier: Apache-2.0
#include <string>
#include <vector>

#include "kiln/core/find_named.h"
#include "kiln/material/naming.h"

namespace kiln {
namespace {

// A file of its own for one slot.
NamingToken whole(std::string_view token, Slot slot) {
  return {token, {{slot, slot_facts(slot).channels == 3 ? "rgb" : "r"}}};
}

NamingToken normal(std::string_view token, NormalConvention convention) {
  return {token, {{Slot::Normal, "rgb"}}, convention};
}

NamingToken packed(std::string_view token, std::vector<TokenTarget> targets) {
  return {token, std::move(targets)};
}

// A specular map that may be a colour or a level.
NamingToken specular(std::string_view token) {
  return {token, {{Slot::SpecularColor, "rgb"}}, NormalConvention::Auto, true};
}

NamingToken occlusion_roughness_metallic(std::string_view token) {
  return packed(token,
                {{Slot::AmbientOcclusion, "r"}, {Slot::Roughness, "g"}, {Slot::Metallic, "b"}});
}

NamingToken with_alpha(std::string_view token, Slot slot) {
  return packed(token, {{slot, "rgb"}, {Slot::Opacity, "a"}});
}

NamingScheme polyhaven() {
  return {"polyhaven",
          "Poly Haven: rock_diff_2k.jpg, rock_nor_gl_2k.exr, rock_arm_2k.png",
          {whole("diff", Slot::BaseColor), whole("rough", Slot::Roughness),
           whole("metal", Slot::Metallic), normal("nor_gl", NormalConvention::OpenGl),
           normal("nor_dx", NormalConvention::DirectX), normal("nor", NormalConvention::Auto),
           whole("disp", Slot::Height), whole("ao", Slot::AmbientOcclusion),
           occlusion_roughness_metallic("arm"), whole("spec", Slot::SpecularLevel),
           whole("alpha", Slot::Opacity), whole("emission", Slot::Emissive)}};
}

NamingScheme ambientcg() {
  return {"ambientcg",
          "ambientCG: Rock020_1K_Color.jpg, Rock020_1K_NormalGL.jpg",
          {whole("Color", Slot::BaseColor), whole("Roughness", Slot::Roughness),
           whole("Metalness", Slot::Metallic), normal("NormalGL", NormalConvention::OpenGl),
           normal("NormalDX", NormalConvention::DirectX), normal("Normal", NormalConvention::Auto),
           whole("Displacement", Slot::Height), whole("AmbientOcclusion", Slot::AmbientOcclusion),
           whole("Opacity", Slot::Opacity), whole("Emission", Slot::Emissive)}};
}

NamingScheme substance() {
  return {"substance",
          "Substance and Unity exports: Rock_BaseColor.png, Rock_ORM.png, Rock_MaskMap.png",
          {whole("BaseColor", Slot::BaseColor),
           whole("Diffuse", Slot::Diffuse),
           whole("Roughness", Slot::Roughness),
           whole("Glossiness", Slot::Gloss),
           whole("Smoothness", Slot::Gloss),
           whole("Metallic", Slot::Metallic),
           normal("NormalOpenGL", NormalConvention::OpenGl),
           normal("NormalDirectX", NormalConvention::DirectX),
           normal("Normal", NormalConvention::Auto),
           whole("Height", Slot::Height),
           whole("AmbientOcclusion", Slot::AmbientOcclusion),
           whole("SpecularLevel", Slot::SpecularLevel),
           specular("Specular"),
           whole("Opacity", Slot::Opacity),
           whole("Emissive", Slot::Emissive),
           occlusion_roughness_metallic("OcclusionRoughnessMetallic"),
           occlusion_roughness_metallic("ORM"),
           with_alpha("AlbedoTransparency", Slot::BaseColor),
           packed("MetallicSmoothness", {{Slot::Metallic, "r"}, {Slot::Gloss, "a"}}),
           packed("SpecularSmoothness", {{Slot::SpecularColor, "rgb"}, {Slot::Gloss, "a"}}),
           packed("MaskMap",
                  {{Slot::Metallic, "r"}, {Slot::AmbientOcclusion, "g"}, {Slot::Gloss, "a"}}),
           whole("BC", Slot::BaseColor),
           whole("D", Slot::BaseColor),
           whole("R", Slot::Roughness),
           whole("M", Slot::Metallic),
           normal("N", NormalConvention::Auto),
           whole("H", Slot::Height),
           whole("AO", Slot::AmbientOcclusion),
           whole("O", Slot::AmbientOcclusion),
           whole("E", Slot::Emissive)}};
}

NamingScheme gltf() {
  return {"gltf",
          "glTF 2.0: Box_baseColor.png, Box_metallicRoughness.png, Box_specularGlossiness.png",
          {whole("baseColor", Slot::BaseColor), with_alpha("baseColorAlpha", Slot::BaseColor),
           whole("diffuse", Slot::Diffuse), with_alpha("diffuseAlpha", Slot::Diffuse),
           packed("metallicRoughness", {{Slot::Roughness, "g"}, {Slot::Metallic, "b"}}),
           occlusion_roughness_metallic("occlusionRoughnessMetallic"),
           packed("specularGlossiness", {{Slot::SpecularColor, "rgb"}, {Slot::Gloss, "a"}}),
           normal("normal", NormalConvention::OpenGl), whole("occlusion", Slot::AmbientOcclusion),
           whole("emissive", Slot::Emissive)},
          NormalConvention::OpenGl};
}

NamingScheme generic() {
  return {"generic",
          "words as artists write them: albedo, col, rgh, nrm, disp, spec, ...",
          {whole("basecolor", Slot::BaseColor),
           whole("albedo", Slot::BaseColor),
           whole("color", Slot::BaseColor),
           whole("col", Slot::BaseColor),
           whole("base", Slot::BaseColor),
           whole("diffuse", Slot::Diffuse),
           whole("diff", Slot::Diffuse),
           with_alpha("albedoAlpha", Slot::BaseColor),
           with_alpha("colorAlpha", Slot::BaseColor),
           whole("roughness", Slot::Roughness),
           whole("rough", Slot::Roughness),
           whole("rgh", Slot::Roughness),
           whole("glossiness", Slot::Gloss),
           whole("gloss", Slot::Gloss),
           whole("glossy", Slot::Gloss),
           whole("smoothness", Slot::Gloss),
           whole("metallic", Slot::Metallic),
           whole("metalness", Slot::Metallic),
           whole("metal", Slot::Metallic),
           whole("mtl", Slot::Metallic),
           normal("normal_gl", NormalConvention::OpenGl),
           normal("normal_opengl", NormalConvention::OpenGl),
           normal("normal_dx", NormalConvention::DirectX),
           normal("normal_directx", NormalConvention::DirectX),
           normal("normal", NormalConvention::Auto),
           normal("normals", NormalConvention::Auto),
           normal("normalmap", NormalConvention::Auto),
           normal("nor", NormalConvention::Auto),
           normal("nrm", NormalConvention::Auto),
           normal("nrml", NormalConvention::Auto),
           normal("norm", NormalConvention::Auto),
           whole("displacement", Slot::Height),
           whole("displace", Slot::Height),
           whole("disp", Slot::Height),
           whole("dsp", Slot::Height),
           whole("height", Slot::Height),
           whole("heightmap", Slot::Height),
           whole("ambientocclusion", Slot::AmbientOcclusion),
           whole("occlusion", Slot::AmbientOcclusion),
           whole("ao", Slot::AmbientOcclusion),
           whole("specular_color", Slot::SpecularColor),
           whole("specular_f0", Slot::SpecularColor),
           whole("f0", Slot::SpecularColor),
           whole("specular_level", Slot::SpecularLevel),
           specular("specular"),
           specular("specularity"),
           specular("spec"),
           specular("spc"),
           whole("opacity", Slot::Opacity),
           whole("alpha", Slot::Opacity),
           whole("emission", Slot::Emissive),
           whole("emissive", Slot::Emissive),
           whole("emit", Slot::Emissive)}};
}

// The suffixes of assets named after their kind, T_Rock_N, and packed maps by their letters. The
// engine's normals point down.
NamingScheme unreal() {
  return {"unreal",
          "Unreal: T_Rock_BC.png, T_Rock_N.png (DirectX), T_Rock_ORM.png; first where all begin T_",
          {whole("BaseColor", Slot::BaseColor),
           whole("BC", Slot::BaseColor),
           whole("D", Slot::BaseColor),
           whole("Roughness", Slot::Roughness),
           whole("R", Slot::Roughness),
           whole("Metallic", Slot::Metallic),
           whole("M", Slot::Metallic),
           normal("Normal", NormalConvention::Auto),
           normal("N", NormalConvention::Auto),
           whole("Height", Slot::Height),
           whole("H", Slot::Height),
           whole("AmbientOcclusion", Slot::AmbientOcclusion),
           whole("AO", Slot::AmbientOcclusion),
           whole("O", Slot::AmbientOcclusion),
           whole("Specular", Slot::SpecularLevel),
           whole("Opacity", Slot::Opacity),
           whole("Emissive", Slot::Emissive),
           whole("E", Slot::Emissive),
           occlusion_roughness_metallic("OcclusionRoughnessMetallic"),
           occlusion_roughness_metallic("ORM"),
           packed("MRA",
                  {{Slot::Metallic, "r"}, {Slot::Roughness, "g"}, {Slot::AmbientOcclusion, "b"}}),
           packed("RMA",
                  {{Slot::Roughness, "r"}, {Slot::Metallic, "g"}, {Slot::AmbientOcclusion, "b"}})},
          NormalConvention::DirectX,
          "T_"};
}

// The words that the Principled setup of Node Wrangler looks for. Blender's normals point up.
NamingScheme blender() {
  constexpr NormalConvention up = NormalConvention::OpenGl;
  return {"blender",
          "Blender, as Node Wrangler reads names: wood_col, wood_rgh, wood_nrm, wood_bump, ...",
          {whole("diffuse", Slot::BaseColor),
           whole("diff", Slot::BaseColor),
           whole("albedo", Slot::BaseColor),
           whole("base", Slot::BaseColor),
           whole("col", Slot::BaseColor),
           whole("color", Slot::BaseColor),
           whole("basecolor", Slot::BaseColor),
           whole("metallic", Slot::Metallic),
           whole("metalness", Slot::Metallic),
           whole("metal", Slot::Metallic),
           whole("mtl", Slot::Metallic),
           whole("specularity", Slot::SpecularLevel),
           whole("specular", Slot::SpecularLevel),
           whole("spec", Slot::SpecularLevel),
           whole("spc", Slot::SpecularLevel),
           whole("roughness", Slot::Roughness),
           whole("rough", Slot::Roughness),
           whole("rgh", Slot::Roughness),
           whole("gloss", Slot::Gloss),
           whole("glossy", Slot::Gloss),
           whole("glossiness", Slot::Gloss),
           normal("normal", up),
           normal("nor", up),
           normal("nrm", up),
           normal("nrml", up),
           normal("norm", up),
           whole("displacement", Slot::Height),
           whole("displace", Slot::Height),
           whole("disp", Slot::Height),
           whole("dsp", Slot::Height),
           whole("height", Slot::Height),
           whole("heightmap", Slot::Height),
           whole("bump", Slot::Height),
           whole("bmp", Slot::Height),
           whole("ao", Slot::AmbientOcclusion),
           whole("ambientocclusion", Slot::AmbientOcclusion),
           whole("alpha", Slot::Opacity),
           whole("opacity", Slot::Opacity),
           whole("emission", Slot::Emissive),
           whole("emissive", Slot::Emissive),
           whole("emit", Slot::Emissive)}};
}

// `_d` is displacement and `_m` metal here, elsewhere diffuse and, at times, a mask: this scheme
// comes last, and has those letters only where it is asked for.
NamingScheme o3de() {
  return {"o3de",
          "O3DE: rock_basecolor, rock_ddn, rock_mt, rock_ht; _d is displacement where it is stated",
          {whole("alb", Slot::BaseColor),
           whole("albedo", Slot::BaseColor),
           whole("basecolor", Slot::BaseColor),
           whole("bc", Slot::BaseColor),
           whole("col", Slot::BaseColor),
           whole("color", Slot::BaseColor),
           whole("diff", Slot::BaseColor),
           whole("diffuse", Slot::BaseColor),
           whole("rough", Slot::Roughness),
           whole("roughness", Slot::Roughness),
           whole("g", Slot::Gloss),
           whole("gloss", Slot::Gloss),
           whole("m", Slot::Metallic),
           whole("metal", Slot::Metallic),
           whole("metallic", Slot::Metallic),
           whole("metalness", Slot::Metallic),
           whole("mt", Slot::Metallic),
           whole("mtl", Slot::Metallic),
           normal("ddn", NormalConvention::Auto),
           normal("n", NormalConvention::Auto),
           normal("nm", NormalConvention::Auto),
           normal("nor", NormalConvention::Auto),
           normal("norm", NormalConvention::Auto),
           normal("normal", NormalConvention::Auto),
           normal("normalmap", NormalConvention::Auto),
           normal("normals", NormalConvention::Auto),
           normal("nrm", NormalConvention::Auto),
           whole("d", Slot::Height),
           whole("disp", Slot::Height),
           whole("displ", Slot::Height),
           whole("displacement", Slot::Height),
           whole("dm", Slot::Height),
           whole("dsp", Slot::Height),
           whole("h", Slot::Height),
           whole("height", Slot::Height),
           whole("hm", Slot::Height),
           whole("ht", Slot::Height),
           whole("amb", Slot::AmbientOcclusion),
           whole("ambientocclusion", Slot::AmbientOcclusion),
           whole("ambocc", Slot::AmbientOcclusion),
           whole("ao", Slot::AmbientOcclusion),
           whole("f0", Slot::SpecularColor),
           whole("specf0", Slot::SpecularColor),
           specular("spec"),
           specular("specular"),
           whole("op", Slot::Opacity),
           whole("opacity", Slot::Opacity),
           whole("mask", Slot::Opacity),
           whole("e", Slot::Emissive),
           whole("em", Slot::Emissive),
           whole("emissive", Slot::Emissive),
           whole("emit", Slot::Emissive),
           whole("glow", Slot::Emissive)}};
}

}  // namespace

const std::vector<NamingScheme>& all_naming_schemes() {
  static const std::vector<NamingScheme> schemes = {polyhaven(), ambientcg(), substance(), gltf(),
                                                    generic(),   unreal(),    blender(),   o3de()};
  return schemes;
}

const NamingScheme& find_naming_scheme(std::string_view name) {
  return find_named(all_naming_schemes(), "naming scheme", name);
}

}  // namespace kiln

// SPDX-License-Identifier: Apache-2.0
#include "lut_presets.h"

#include "kiln/core/error.h"
#include "kiln/core/find_named.h"
#include "kiln/core/names.h"

namespace kiln {
namespace {

using Settings = std::vector<std::pair<std::string, std::string>>;

Settings with(Settings settings, const std::string& channels, const std::string& size) {
  settings.emplace_back("channels", channels);
  settings.emplace_back("size", size);
  return settings;
}

// Of tables whose own lobe is cloth's: all but the cloth channel are of GGX.
Settings ggx(Settings settings) {
  settings.emplace_back("distribution", "ggx");
  settings.emplace_back("masking", "smith-correlated");
  return settings;
}

// The layouts that presets share.
const Settings centred = {{"axes", "mu,roughness"}, {"align", "center"}, {"origin", "top"}};
const Settings centred_flipped = {
    {"axes", "mu,roughness"}, {"align", "center"}, {"origin", "bottom"}};
const Settings roughness_first_corner = {
    {"axes", "roughness,mu"}, {"align", "corner"}, {"origin", "top"}};

std::vector<LutPreset> make_list() {
  return {
      {"khronos",
       "glTF sample viewers: F0 * R + G, cloth in B",
       "uint8",
       {{"split-sum", with(centred, "scale,bias,sheen-clamped", "128x128")},
        {"sheen", with(centred, "zero,zero,sheen-clamped", "128x128")}},
       {"the Khronos sampler's cloth table applies a uniform-hemisphere estimator to importance "
        "samples, with roughness in place of its square (0.320 at (0.5, 0.5), where the integral "
        "is "
        "0.2296); this one is the integral",
        "8 bits round to 2e-3; --type uint16 keeps the entries"}},
      {"filament",
       "Filament, single scattering: F0 * R + G",
       "half",
       {{"split-sum", with(centred_flipped, "scale,bias", "128x128")}},
       {"cmgen writes each row for the roughness of the next one (up to 0.02 off at 128 rows); "
        "this "
        "one holds each row's own"}},
      {"filament-multiscatter",
       "Filament, multiple scattering: mix(R, G, F0)",
       "half",
       {{"split-sum", with(centred_flipped, "fresnel,total", "128x128")}},
       {"cmgen writes each row for the roughness of the next one; this one holds each row's own"}},
      {"filament-cloth",
       "Filament, multiple scattering and cloth in B",
       "half",
       {{"split-sum", with(centred_flipped, "fresnel,total,sheen", "128x128")},
        {"sheen", ggx(with(centred_flipped, "fresnel,total,sheen", "128x128"))}},
       {"cmgen writes each row for the roughness of the next one; this one holds each row's own",
        "the cloth lobe reflects more than it receives at grazing angles (values above 1)"}},
      {"three",
       "three.js: transposed, roughness along x",
       "half",
       {{"split-sum", with({{"axes", "roughness,mu"}, {"align", "center"}, {"origin", "top"}},
                           "scale,bias", "16x16")}},
       {}},
      {"babylon",
       "Babylon.js: mix(R, G, F0), cloth in B, RGBD",
       "rgbd8",
       {{"split-sum", with(centred, "fresnel,total,sheen", "256x256")}},
       {"8-bit RGBD rounds by up to 5e-3; values above 1 cost precision"}},
      {"godot",
       "Godot: mix(R, G, F0), cloth in B, rough rows last first",
       "half",
       {{"split-sum", with(centred_flipped, "fresnel,total,sheen", "128x128")}},
       {"Godot's own table uses Schlick's masking with k = alpha / 2, up to 0.28 from the exact "
        "height-correlated form used here; --masking schlick-ggx makes that one"}},
      {"unreal",
       "Unreal: F0 * R + G, 128 by 32",
       "uint16",
       {{"split-sum", with(centred, "scale,bias", "128x32")}},
       {"Unreal's own table uses an approximate joint masking, up to 0.23 from the exact form used "
        "here; --masking unreal-joint makes that one"}},
      {"unity-hdrp",
       "Unity HDRP: mix(R, G, F0) over sqrt(n.v), Disney's diffuse less 1/2 in B",
       "rgb10a2",
       {{"split-sum", with({{"axes", "sqrt-mu,roughness"}, {"align", "corner"}, {"origin", "top"}},
                           "fresnel,total,unity-disney", "64x64")}},
       {"10 bits round to 5e-4"}},
      {"materialx",
       "MaterialX: F0 * R + F90 * G over alpha, cloth in B",
       "float",
       {{"split-sum", with({{"axes", "mu,alpha"}, {"align", "center"}, {"origin", "top"}},
                           "scale,bias,sheen", "64x64")}},
       {"MaterialX names alpha 'roughness' in its nodes; the y axis is that alpha"}},
      {"cycles",
       "Cycles: albedo over roughness and n.v, entries on the borders",
       "float",
       {{"directional-albedo", with(roughness_first_corner, "total", "32x32")},
        {"average-albedo",
         {{"axes", "roughness"}, {"align", "corner"}, {"channels", "average"}, {"size", "32"}}},
        {"ior-share",
         {{"axes", "roughness,mu,fourth-root-f0"},
          {"align", "corner"},
          {"origin", "top"},
          {"size", "16x16"},
          {"depth", "16"}}},
        {"schlick-share",
         {{"axes", "roughness,mu,schlick-exponent"},
          {"align", "corner"},
          {"origin", "top"},
          {"size", "16x16"},
          {"depth", "16"}}},
        {"glass",
         {{"axes", "roughness,mu,ior"},
          {"align", "corner"},
          {"origin", "top"},
          {"channels", "enter-total"},
          {"size", "16x16"},
          {"depth", "16"}}}},
       {"Cycles fills the slice of index 1 with ones, and its tables of leaving light count what "
        "refraction turns back to the side it came from; these hold what gets through"}},
      {"ltc",
       "linearly transformed cosines: matrices, and their magnitudes as split-sum",
       "half",
       {{"ltc",
         {{"axes", "roughness,sqrt-one-minus-mu"},
          {"align", "corner"},
          {"origin", "top"},
          {"size", "64x64"}}},
        {"split-sum",
         with({{"axes", "roughness,sqrt-one-minus-mu"}, {"align", "corner"}, {"origin", "top"}},
              "total,bias,zero,sphere", "64x64")}},
       {"the published magnitudes come from 32 x 32 samples and err by up to 0.066; these are "
        "exact"}},
      {"openpbr",
       "Adobe's OpenPBR: 1 - E over n.v and sqrt(alpha), separable masking",
       "uint16",
       {{"directional-albedo",
         {{"axes", "mu,sqrt-alpha"},
          {"align", "corner"},
          {"origin", "top"},
          {"channels", "complement"},
          {"masking", "smith-separable"},
          {"size", "32x32"}}}},
       {}},
  };
}

}  // namespace

const std::vector<LutPreset>& all_lut_presets() {
  static const std::vector<LutPreset> presets = make_list();
  return presets;
}

std::vector<std::string> lut_preset_names() {
  std::vector<std::string> names;
  for (const LutPreset& preset : all_lut_presets()) names.push_back(preset.name);
  return names;
}

const LutPreset& find_lut_preset(const std::string& name) {
  return find_named(all_lut_presets(), "preset", name);
}

const LutPreset::Table& preset_table(const LutPreset& preset, const std::string& table) {
  std::string known;
  for (const LutPreset::Table& one : preset.tables) {
    if (one.table == kebab(table)) return one;
    known += (known.empty() ? "" : ", ") + one.table;
  }
  throw Error(Fault::Usage,
              "preset: " + preset.name + " has no table '" + table + "'; it has " + known);
}

}  // namespace kiln

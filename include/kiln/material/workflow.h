// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "kiln/core/param.h"
#include "kiln/image/wrap.h"
#include "kiln/material/normals.h"
#include "kiln/material/slot_decoding.h"
#include "kiln/material/slots.h"
#include "kiln/material/svbrdf.h"

namespace kiln {

/// How named maps come to diffuse colour, reflectance and roughness.
///
/// * metal-rough: diffuse = base (1 - metallic); F0 = lerp(F0 of the dielectric, base, metallic).
///   The dielectric has the reflectance that the specular level stands for, times specular tint (at
///   most 1), times specular weight.
/// * spec-gloss: diffuse and F0 = specular colour as they are; roughness = 1 - gloss.
/// * albedo-specular-roughness: diffuse = albedo as it is; F0 = specular colour, or the reflectance
///   that a specular level stands for, tinted and weighed likewise; roughness.
///
/// The glTF extension KHR_materials_pbrSpecularGlossiness multiplies diffuse by 1 - max(specular),
/// glTF's metallic-roughness model mixes the two lobes by Fresnel instead. Both keep energy by
/// leaving to the diffuse lobe what the specular one does not reflect. kiln does that at shading
/// time, with the directional albedo of the specular lobe, for every workflow alike: multiplying
/// here too would count it twice, and would part two exports of one surface by 4 %.
enum class Workflow { MetalRough, SpecGloss, AlbedoSpecularRoughness };
inline constexpr std::array<std::string_view, 3> workflow_names = {"metal-rough", "spec-gloss",
                                                                   "albedo-specular-roughness"};
constexpr std::string_view workflow_name(Workflow workflow) {
  return workflow_names[static_cast<size_t>(workflow)];
}

/// @error Fault::Usage, naming the nearest known workflow
Workflow parse_workflow(std::string_view name);

/// What a specular level stands for.
///
///     level        F0 = 0.08 s                       0.5 is 4 %
///     f0           F0 = s
///     ior          F0 = ((s - 1) / (s + 1))^2        1.5 is 4 %
///     reflectance  F0 = 0.16 s^2                     0.5 is 4 %
///
/// @source Burley 2012 (level); Lagarde & de Rousiers 2014 (reflectance); Fresnel (ior)
enum class SpecularEncoding { Level, F0, Ior, Reflectance };
inline constexpr std::array<std::string_view, 4> specular_encoding_names = {"level", "f0", "ior",
                                                                            "reflectance"};
/// @error Fault::Usage, naming the nearest known encoding
SpecularEncoding parse_specular_encoding(std::string_view name);

/// Reflectance at normal incidence; values outside the encoding's range are clamped to it.
float f0_of(SpecularEncoding encoding, float value);

/// The workflow that maps for these slots belong to, and why.
struct WorkflowGuess {
  Workflow workflow = Workflow::MetalRough;
  std::string reason;
};
WorkflowGuess guess_workflow(const std::vector<Slot>& given);

/// The slots out of `given` that `resolve` reads in this workflow; gloss stands in for roughness
/// and diffuse for base colour, and the other way round. Height is not among them: it is read in
/// addition where the convention of a normal map is not stated. Tint, weight and anisotropy are
/// read where they are given.
std::vector<Slot> slots_read(Workflow workflow, const std::vector<Slot>& given);

/// What is given for one slot: an image, or a constant.
struct SlotMap {
  Layers image;  ///< colour in the working space, normals as stored; one or three planes
  std::optional<std::array<float, 3>> value;  ///< where the image is empty; scalars use the first
  NormalConvention convention = NormalConvention::Auto;  ///< of a normal map, as its name says
  SpecularEncoding encoding = SpecularEncoding::Level;   ///< of a specular level
  SlotDecoding decoding;
  std::string source;  ///< file name, for the notes
};
using SlotMaps = std::map<Slot, SlotMap>;

/// Wrap as stated; `Auto` is what the material's document says, else repeat.
enum class WrapChoice { Auto, Repeat, Clamp, Mirror };
inline constexpr std::array<std::string_view, 4> wrap_choice_names = {"auto", "repeat", "clamp",
                                                                      "mirror"};
constexpr Wrap settled(WrapChoice choice) {
  return choice == WrapChoice::Auto ? Wrap::Repeat
                                    : static_cast<Wrap>(static_cast<int>(choice) - 1);
}

struct WorkflowSettings {
  Workflow workflow = Workflow::MetalRough;
  NormalConvention normal = NormalConvention::Auto;  ///< stated, it outranks the map's name
  NormalZero normal_zero = NormalZero::Both;
  NormalRange normal_range = NormalRange::Auto;
  WrapChoice wrap = WrapChoice::Auto;
};

/// The settings by name, for command lines and pipeline files.
const Params<WorkflowSettings>& workflow_params();

struct Resolved {
  Svbrdf svbrdf;
  std::vector<std::string> notes;     ///< what was assumed, resampled, repaired or left out
  std::vector<std::string> warnings;  ///< what may be wrong
};

/// Named maps to one BRDF per texel, of the size of the largest map that is read.
///
/// Missing maps are the constants of the list of slots; NaN and Inf are replaced by them; values
/// outside their range are clamped; all of that is told in the notes.
///
/// @error Fault::Input when a map has no texels or a normal map one channel only
Resolved resolve(SlotMaps maps, const WorkflowSettings& settings);

}  // namespace kiln

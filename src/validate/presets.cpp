// SPDX-License-Identifier: Apache-2.0
#include "presets.h"

#include <algorithm>

namespace kiln::validate {
namespace {

struct Preset {
  std::string name;
  TableAxes axes;
  std::vector<Meaning> meanings;
  std::string masking = "smith-correlated";
};

constexpr TableAxes upright{};
constexpr TableAxes reversed{.width_reversed = true};
constexpr TableAxes transposed{.transposed = true};
constexpr TableAxes hdrp{
    .cosine = CosineAxis::SquareRoot, .cosine_alignment = nodes, .width_alignment = nodes};
constexpr TableAxes by_alpha{.width = WidthAxis::Alpha};
constexpr TableAxes cycles{.transposed = true, .cosine_alignment = nodes, .width_alignment = nodes};
constexpr TableAxes cosines{.transposed = true,
                            .cosine = CosineAxis::OneMinusRoot,
                            .cosine_reversed = true,
                            .cosine_alignment = nodes,
                            .width_alignment = nodes};
constexpr TableAxes openpbr{.cosine_alignment = nodes, .width_alignment = nodes};

const std::vector<Preset>& all_presets() {
  using enum Meaning;
  static const std::vector<Preset> presets{
      {"khronos", upright, {Scale, Bias}},
      {"khronos", upright, {Scale, Bias, Albedo}},
      {"khronos", upright, {Albedo}, "neubelt-clamped"},
      {"filament", reversed, {Scale, Bias}},
      {"filament-multiscatter", reversed, {Bias, Albedo}},
      {"filament-cloth", reversed, {Bias, Albedo, Albedo}},
      {"three", transposed, {Scale, Bias}},
      {"babylon", upright, {Bias, Albedo, Albedo}},
      {"godot", reversed, {Bias, Albedo, Albedo}},
      {"unreal", upright, {Scale, Bias}},
      {"unreal", upright, {Scale, Bias}, "hammon"},
      {"unity-hdrp", hdrp, {Bias, Albedo, UnityDisney}},
      {"unity-hdrp", hdrp, {Bias, Albedo, BurleyLessHalf}},
      {"materialx", by_alpha, {Scale, Bias}},
      {"materialx", by_alpha, {Scale, Bias, Albedo}},
      {"cycles", cycles, {Albedo}},
      {"ltc", cosines, {Albedo, Bias}},
      {"ltc", cosines, {Albedo, Bias, SphereFormFactor}},
      {"openpbr", openpbr, {Loss}, "smith-separable"},
  };
  return presets;
}

bool same_meanings(const Preset& preset, const Candidate& candidate) {
  std::vector<Meaning> meanings;
  for (const ChannelFit& fit : candidate.fits) {
    if (fit.constant || fit.rms > 0.05) continue;
    meanings.push_back(fit.meaning);
    if (fit.model < 0 || tried_lobes()[fit.model].sheen) continue;
    if (tried_lobes()[fit.model].lobe.masking != preset.masking) return false;
    if (tried_lobes()[fit.model].lobe.distribution != "ggx") return false;
  }
  return meanings == preset.meanings;
}

// Averages of GGX over roughness, on nodes.
std::vector<std::string> curve_presets(const Candidate& candidate) {
  const TableAxes& axes = candidate.axes;
  const bool width = axes.width == WidthAxis::Roughness && !axes.width_reversed;
  if (!width || axes.width_alignment != nodes || candidate.fits.size() != 1) return {};
  const ChannelFit& fit = candidate.fits[0];
  if (fit.constant || fit.model < 0 || fit.meaning != Meaning::Albedo) return {};
  const Lobe& lobe = tried_lobes()[fit.model].lobe;
  if (lobe.distribution != "ggx" || lobe.masking != "smith-correlated") return {};
  return {"cycles"};
}

}  // namespace

std::vector<std::string> presets_like(const Sheet& sheet, const Candidate& candidate) {
  std::vector<std::string> names;
  if (sheet.is_curve()) return curve_presets(candidate);
  // Pictures of some engines are upside down; numbers in a text begin with the row of texel (0, 0).
  const bool text = sheet.array->stored == NumberArray::Stored::Integer ||
                    sheet.array->stored == NumberArray::Stored::Decimal;
  for (const Preset& preset : all_presets()) {
    TableAxes axes = preset.axes;
    if (text) axes.width_reversed = false;
    if (!(axes == candidate.axes) || !same_meanings(preset, candidate)) continue;
    if (std::find(names.begin(), names.end(), preset.name) == names.end()) {
      names.push_back(preset.name);
    }
  }
  return names;
}

}  // namespace kiln::validate

// SPDX-License-Identifier: Apache-2.0
#include "environment_recipe.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <bit>

#include "kiln/brdf/models.h"

namespace kiln {
namespace {

using Settings = EnvironmentBake::Settings;

template <class Names>
std::vector<std::string> words(const Names& names) {
  return {names.begin(), names.end()};
}

size_t index_in(const std::vector<std::string>& names, const std::string& name) {
  return static_cast<size_t>(std::find(names.begin(), names.end(), name) - names.begin());
}

std::vector<std::string> format_names() {
  std::vector<std::string> names;
  for (const EnvironmentFormat& format : all_environment_formats()) names.push_back(format.name);
  return names;
}

std::vector<std::string> encoding_names() {
  std::vector<std::string> names;
  for (const EnvironmentFormat& format : all_environment_formats()) {
    for (const std::string& encoding : format.encodings) {
      if (std::count(names.begin(), names.end(), encoding) == 0) names.push_back(encoding);
    }
  }
  return names;
}

// Of a member: what is given, else what the preset says, else the default.
std::string chosen(const Settings& given, const Settings& preset, std::string Settings::*member,
                   const std::string& initial) {
  if (!(given.*member).empty()) return given.*member;
  return (preset.*member).empty() ? initial : preset.*member;
}

[[noreturn]] void refuse(const std::string& text) { throw Error(Fault::Usage, text); }

void check_encoding(const EnvironmentFormat& format, const std::string& encoding) {
  const auto& held = format.encodings;
  if (std::count(held.begin(), held.end(), encoding) > 0) return;
  refuse(fmt::format("encoding: {} does not hold {}, expected {}", format.name, encoding,
                     fmt::join(held, " or ")));
}

void check_env(const EnvironmentRecipe& choice) {
  if (choice.format.name != "env") return;
  const int size = choice.plan.sizes.front();
  if (choice.layout != SphereLayout::Cube || !std::has_single_bit(static_cast<unsigned>(size)) ||
      choice.plan.sizes.back() != 1) {
    refuse(
        fmt::format("format: env holds cubes of 2^n texels with levels down to 1; found layout "
                    "{}, size {}, curve {} with {} levels (curve babylon has them all)",
                    sphere_layout_names[static_cast<size_t>(choice.layout)], size, choice.curve,
                    choice.plan.sizes.size()));
  }
}

void check_layout(const EnvironmentRecipe& choice) {
  const std::string_view layout = sphere_layout_names[static_cast<size_t>(choice.layout)];
  if (choice.layout != SphereLayout::Cube && !choice.axes.is_identity()) {
    refuse(fmt::format("axes: found {} with layout {}; expected x,y,z, or layout cube",
                       choice.axes_text, layout));
  }
  if (choice.format.at_nodes && choice.layout == SphereLayout::Octahedral) {
    refuse("format: exr-mip holds cubes and lat-long images; found layout octahedral");
  }
}

void check_roughness(const EnvironmentRecipe& choice) {
  for (const double roughness : choice.plan.roughness) {
    const double alpha = square(roughness);
    if (roughness == 0 || alpha >= Prefilter::least_alpha) continue;
    refuse(fmt::format(
        "curve: {} asks for roughness {:.3g} of a chain of {}; expected 0, or {:.3g} "
        "and more",
        choice.curve, roughness, choice.plan.sizes.front(), std::sqrt(Prefilter::least_alpha)));
  }
}

}  // namespace

Params<Settings> EnvironmentBake::params() {
  return {
      choice_param("preset", &Settings::preset, environment_preset_names(), "layout of an engine"),
      integer_param("size", &Settings::size, {16, 4096}, "edge of a cube face of the first level"),
      choice_param("layout", &Settings::layout, words(sphere_layout_names),
                   "six faces, 2N x N, or 2N x 2N"),
      text_param("curve", &Settings::curve,
                 "roughness along the levels (kiln list curves), or a list: 0,0.3,1"),
      choice_param("format", &Settings::format, format_names(), "of the images"),
      choice_param("encoding", &Settings::encoding, encoding_names(), "numbers of the images"),
      choice_param("supercompression", &Settings::supercompression, {"none", "zstd"},
                   "of KTX 2, without loss"),
      choice_param("distribution", &Settings::distribution, model_names("distribution"),
                   "microfacet normals, isotropic"),
      number_param("shape", &Settings::shape, {0, 1000}, "",
                   "of distributions that have one; 0: its default"),
      text_param("axes", &Settings::axes, "the engine's x, y, z in kiln's: -x,y,z mirrors"),
      integer_param("sh_order", &Settings::sh_order, {0, 32}, "of the spherical harmonics"),
      choice_param("sh_window", &Settings::sh_window, words(sh_window_names),
                   "damps the ringing of harmonics"),
  };
}

EnvironmentRecipe resolve_environment(const Settings& settings) {
  EnvironmentRecipe choice{};
  Settings preset;
  if (!settings.preset.empty()) {
    choice.preset = find_environment_preset(settings.preset);
    for (const auto& [key, text] : choice.preset.settings) {
      assign(EnvironmentBake::params(), preset, key, text);
    }
  }
  const auto text = [&](std::string Settings::*member, const std::string& initial) {
    return chosen(settings, preset, member, initial);
  };
  choice.layout = static_cast<SphereLayout>(
      index_in(words(sphere_layout_names), text(&Settings::layout, "cube")));
  choice.curve = text(&Settings::curve, "filament");
  choice.plan = plan_chain(choice.curve, settings.size);
  choice.format = find_environment_format(text(&Settings::format, "exr"));
  // Another format than the preset's has its own default.
  const bool own_format = settings.format.empty() || settings.format == preset.format;
  if (!own_format) preset.encoding.clear();
  choice.encoding = text(&Settings::encoding, choice.format.encodings.front());
  choice.zstd = text(&Settings::supercompression, "none") == "zstd";
  choice.distribution = text(&Settings::distribution, "ggx");
  choice.shape = settings.shape;
  choice.axes_text = text(&Settings::axes, "x,y,z");
  choice.axes = parse_axes(choice.axes_text);
  choice.sh_order = settings.sh_order;
  choice.sh_window =
      static_cast<ShWindow>(index_in(words(sh_window_names), text(&Settings::sh_window, "none")));
  check_encoding(choice.format, choice.encoding);
  if (choice.zstd && !choice.format.supercompresses) {
    refuse(fmt::format("supercompression: {} has none, expected format ktx2", choice.format.name));
  }
  check_layout(choice);
  check_roughness(choice);
  check_env(choice);
  return choice;
}

}  // namespace kiln

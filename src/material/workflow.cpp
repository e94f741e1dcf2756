// SPDX-License-Identifier: Apache-2.0
#include "kiln/material/workflow.h"

#include <algorithm>

#include "kiln/core/error.h"
#include "kiln/core/names.h"
#include "workflow_reads.h"

namespace kiln {
namespace {

template <size_t N>
size_t parse_word_of(const std::array<std::string_view, N>& names, std::string_view kind,
                     std::string_view word) {
  const auto found = std::find(names.begin(), names.end(), kebab(word));
  if (found != names.end()) return static_cast<size_t>(found - names.begin());
  throw Error(Fault::Usage, unknown_name(kind, word, {names.begin(), names.end()}));
}

template <size_t N>
std::vector<std::string> words_of(const std::array<std::string_view, N>& names) {
  return {names.begin(), names.end()};
}

bool contains(const std::vector<Slot>& slots, Slot slot) {
  return std::find(slots.begin(), slots.end(), slot) != slots.end();
}

}  // namespace

Workflow parse_workflow(std::string_view name) {
  return static_cast<Workflow>(parse_word_of(workflow_names, "workflow", name));
}

SpecularEncoding parse_specular_encoding(std::string_view name) {
  return static_cast<SpecularEncoding>(
      parse_word_of(specular_encoding_names, "specular encoding", name));
}

float f0_of(SpecularEncoding encoding, float value) {
  const float level = std::clamp(value, 0.0f, 1.0f);
  switch (encoding) {
    case SpecularEncoding::Level:
      return 0.08f * level;
    case SpecularEncoding::F0:
      return level;
    case SpecularEncoding::Reflectance:
      return 0.16f * level * level;
    case SpecularEncoding::Ior: {
      const float ior = std::max(value, 1.0f);
      const float r = (ior - 1.0f) / (ior + 1.0f);
      return r * r;
    }
  }
  return 0.0f;
}

WorkflowGuess guess_workflow(const std::vector<Slot>& given) {
  if (contains(given, Slot::Metallic)) return {Workflow::MetalRough, "a metallic map is given"};
  if (!contains(given, Slot::SpecularColor)) {
    return {Workflow::MetalRough, "neither a metallic nor a specular colour map is given"};
  }
  if (contains(given, Slot::Roughness) && !contains(given, Slot::Gloss)) {
    return {Workflow::AlbedoSpecularRoughness,
            "a specular colour and a roughness map are given, and no metallic map"};
  }
  return {Workflow::SpecGloss, "a specular colour map is given, and no metallic map"};
}

const WorkflowReads& workflow_reads(Workflow workflow) {
  static const std::array<WorkflowReads, 3> all = {{
      {{Slot::BaseColor, Slot::Diffuse},
       {Slot::Roughness, Slot::Gloss},
       {Slot::SpecularLevel},
       {Slot::Metallic}},
      {{Slot::Diffuse, Slot::BaseColor},
       {Slot::Gloss, Slot::Roughness},
       {Slot::SpecularColor, Slot::SpecularLevel},
       {}},
      {{Slot::BaseColor, Slot::Diffuse},
       {Slot::Roughness, Slot::Gloss},
       {Slot::SpecularColor, Slot::SpecularLevel},
       {}},
  }};
  return all[static_cast<size_t>(workflow)];
}

std::vector<std::vector<Slot>> alternatives_of(Workflow workflow) {
  const WorkflowReads& reads = workflow_reads(workflow);
  std::vector<std::vector<Slot>> all = {reads.color, reads.width, reads.specular};
  if (!reads.metal.empty()) all.push_back(reads.metal);
  all.push_back({Slot::Normal});
  all.push_back({Slot::AmbientOcclusion});
  return all;
}

std::vector<Slot> optional_slots(Workflow workflow, const std::vector<Slot>& given) {
  std::vector<Slot> slots;
  const auto add_given = [&](Slot slot) {
    if (contains(given, slot)) slots.push_back(slot);
  };
  const std::vector<Slot>& specular = workflow_reads(workflow).specular;
  if (!contains(specular, Slot::SpecularColor) || !contains(given, Slot::SpecularColor)) {
    add_given(Slot::SpecularTint);
    add_given(Slot::SpecularWeight);
  }
  add_given(Slot::Anisotropy);
  if (contains(given, Slot::Anisotropy)) add_given(Slot::AnisotropyAngle);
  return slots;
}

std::vector<Slot> slots_read(Workflow workflow, const std::vector<Slot>& given) {
  std::vector<Slot> read;
  for (const std::vector<Slot>& alternatives : alternatives_of(workflow)) {
    const auto first = std::find_if(alternatives.begin(), alternatives.end(),
                                    [&](Slot slot) { return contains(given, slot); });
    if (first != alternatives.end()) read.push_back(*first);
  }
  for (const Slot slot : optional_slots(workflow, given)) read.push_back(slot);
  return read;
}

const Params<WorkflowSettings>& workflow_params() {
  static const Params<WorkflowSettings> params = {
      word_param("workflow", &WorkflowSettings::workflow, words_of(workflow_names),
                 "how the maps come to diffuse colour, reflectance and roughness"),
      word_param("normal", &WorkflowSettings::normal, words_of(normal_convention_names),
                 "green of the normal map points up (gl) or down (dx)"),
      word_param("normal_zero", &WorkflowSettings::normal_zero, words_of(normal_zero_names),
                 "8-bit code of a normal map that means zero slope"),
      word_param("normal_range", &WorkflowSettings::normal_range, words_of(normal_range_names),
                 "normal maps hold [0,1] or [-1,1]"),
      word_param("wrap", &WorkflowSettings::wrap, words_of(wrap_choice_names),
                 "beyond the edges; auto: as the file says"),
  };
  return params;
}

}  // namespace kiln

// SPDX-License-Identifier: Apache-2.0
#include "material_options.h"

#include <fmt/format.h>

#include <filesystem>

#include "help.h"
#include "kiln/core/error.h"
#include "kiln/core/names.h"
#include "kiln/material/naming.h"

namespace kiln {
namespace {

void apply_reading(const std::vector<std::pair<std::string, std::string>>& reading,
                   SetChoice& set) {
  for (const auto& [key, text] : reading) {
    if (text.empty()) continue;
    if (key != "workflow") {
      assign(workflow_params(), set.reading, key, text);
    } else if (kebab(text) != "auto") {
      set.workflow = parse_workflow(text);
    }
  }
}

}  // namespace

void MaterialOptions::declare(CLI::App& app) {
  app.add_option("--name", name, "which set, where a folder holds several")->type_name("SET");
  app.add_option("--naming", naming, "schemes of file names to try, in order: kiln list namings")
      ->type_name("WORD,...")
      ->delimiter(',')
      ->allow_extra_args(false);
  app.add_option("--packed", packed, "of a lone image its layout, as bake pack takes one")
      ->type_name("LAYOUT");
  reading.reserve(workflow_params().size());
  for (const Param<WorkflowSettings>& param : workflow_params()) {
    reading.emplace_back(param.facts.name, "");
    app.add_option("--" + kebab(param.facts.name), reading.back().second,
                   fmt::format("{}: {}", param.facts.meaning, fmt::join(param.facts.choices, ", ")))
        ->type_name("WORD");
  }
}

void MaterialOptions::declare_models(CLI::App& app) {
  const Params<SurfaceChoice> params = surface_params();
  models.reserve(params.size());
  for (const Param<SurfaceChoice>& param : params) {
    const ParamFacts& facts = param.facts;
    models.emplace_back(facts.name, "");
    app.add_option("--" + kebab(facts.name), models.back().second, facts.meaning)
        ->type_name(facts.kind == ParamFacts::Kind::Word ? "WORD" : "X")
        ->group(of_the_surface);
  }
}

void MaterialOptions::add_to(Pipeline& pipeline) const {
  SetChoice set;
  if (is_material_file(path)) {
    MaterialFile file = read_material_file(path);
    set = std::move(file.set);
    pipeline.material = file.material;
  } else {
    set.path = path;
    set.naming = naming;
    set.packed = layout_text(packed, {});
  }
  set.chosen = name;
  for (const std::string& scheme : naming) find_naming_scheme(scheme);
  apply_reading(reading, set);
  for (const auto& [key, text] : models) {
    if (!text.empty()) assign(surface_params(), pipeline.material.surface, key, text);
  }
  pipeline.sets.push_back(std::move(set));
}

void require_names_for_sets(const Pipeline& pipeline, const std::string& output) {
  const auto names = [&](const char* word) { return output.find(word) != std::string::npos; };
  if (names("{set}") || names("{udim}")) return;
  const std::vector<PlannedSet> sets = planned_sets(pipeline);
  if (sets.size() == 1) return;
  std::vector<std::string> found;
  found.reserve(sets.size());
  for (const PlannedSet& set : sets) found.push_back(set.name);
  throw Error(
      Fault::Usage,
      fmt::format("found {} texture sets: {}; choose one with --name or --workflow, or bake "
                  "all with '{{set}}' in -o",
                  found.size(), fmt::join(found, ", ")));
}

}  // namespace kiln

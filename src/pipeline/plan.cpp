// SPDX-License-Identifier: Apache-2.0
#include "kiln/pipeline/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "glob.h"
#include "kiln/core/find_named.h"
#include "kiln/pipeline/schema.h"
#include "outputs.h"
#include "sets.h"

namespace kiln {
namespace {

namespace fs = std::filesystem;

// A bake of the pipeline with its settings applied, before it is spread over the sets.
struct Prepared {
  const BakeChoice& choice;
  const BakeFacts& facts;
  Task task;
};

const BakeFacts& facts_named(const std::string& bake) {
  return find_named(all_bakes(), "bake", bake);
}

std::optional<size_t> environment_index(const Pipeline& pipeline, const BakeChoice& choice) {
  if (choice.env.empty()) {
    throw Error(Fault::Usage, facts_named(choice.bake).own_lights
                                  ? "nothing to light it with: expected 'env', 'lights' or both"
                                  : "expected 'env'");
  }
  std::vector<std::string> known;
  for (const EnvironmentChoice& environment : pipeline.environments) {
    if (environment.name == choice.env) return known.size();
    known.push_back(environment.name);
  }
  throw Error(Fault::Usage, unknown_name("environment", choice.env, known));
}

Prepared prepare(const Pipeline& pipeline, const BakeChoice& choice, Mistakes& mistakes) {
  const BakeFacts& facts = facts_named(choice.bake);
  const std::shared_ptr<Recipe> recipe = make_recipe(choice.bake);
  for (const Setting& setting : choice.settings) {
    attempt(mistakes, setting.place, [&] { recipe->set(setting.name, setting.text); });
  }
  attempt(mistakes, choice.place, [&] { recipe->check(pipeline.material.surface); });
  Prepared prepared{choice, facts, {}};
  Task& task = prepared.task;
  task.bake = choice.bake;
  task.recipe = recipe;
  task.needs = recipe->needs();
  task.product = facts.product;
  task.output = choice.output;
  task.out = choice.out;
  if (choice.env.empty() && task.needs.own_lights) {
    task.needs.light = task.needs.sampled = task.needs.prefiltered = false;
  }
  if (task.needs.light) {
    const Place& place = choice.env.empty() ? choice.place : choice.env_place;
    attempt(mistakes, place, [&] { task.environment = environment_index(pipeline, choice); });
  }
  return prepared;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (size_t at; (at = text.find(from)) != std::string::npos;) text.replace(at, from.size(), to);
  return text;
}

bool names_tile(const std::string& out) { return out.find("{udim}") != std::string::npos; }

std::string with_set(const std::string& out, const PlannedSet& set) {
  if (!names_tile(out)) return replaced(out, "{set}", set.name);
  if (!set.tile) {
    throw Error(Fault::Usage,
                fmt::format("out: set '{}' has no UDIM tiles, so '{{udim}}' means nothing in '{}'",
                            set.name, out));
  }
  const std::string tile = std::to_string(*set.tile);
  const std::string name = set.name.substr(0, set.name.size() - tile.size() - 1);
  return replaced(replaced(out, "{udim}", tile), "{set}", name);
}

// One name for one file: "a/./b" and "a/b/" are "a/b".
std::string clean_name(const std::string& out, Product product) {
  std::string name = fs::path(out).lexically_normal().generic_string();
  const bool folder = product == Product::Folder || product == Product::Maps;
  if (folder && name.size() > 1 && name.back() == '/') name.pop_back();
  return name;
}

void add_task(const Prepared& prepared, std::optional<size_t> set, Plan& plan, Mistakes& mistakes) {
  Task task = prepared.task;
  task.set = set;
  attempt(mistakes, prepared.choice.place, [&] {
    if (set) task.out = with_set(task.out, plan.sets[*set]);
  });
  task.out = clean_name(task.out, task.product);
  attempt(mistakes, prepared.choice.place, [&] { check_output(task); });
  plan.tasks.push_back(std::move(task));
}

void add_tasks_of_sets(const std::vector<Prepared>& bakes, Plan& plan, Mistakes& mistakes) {
  for (size_t set = 0; set < plan.sets.size(); ++set) {
    for (const Prepared& prepared : bakes) {
      if (prepared.facts.scope == Scope::PerSet) add_task(prepared, set, plan, mistakes);
    }
  }
}

void check_scope(const Prepared& prepared, const Pipeline& pipeline, size_t sets,
                 Mistakes& mistakes) {
  const bool names_set =
      prepared.choice.out.find("{set}") != std::string::npos || names_tile(prepared.choice.out);
  const BakeChoice& choice = prepared.choice;
  if (prepared.facts.scope == Scope::Once && names_set) {
    mistakes.add(choice.place, fmt::format("out: bake '{}' runs once for the whole pipeline, so "
                                           "'{{set}}' means nothing in '{}'",
                                           choice.bake, choice.out));
  }
  if (prepared.facts.scope == Scope::PerSet && pipeline.sets.empty()) {
    mistakes.add(choice.place, fmt::format("bake '{}' runs once per texture set, and the file has "
                                           "no `sets`",
                                           choice.bake));
  }
  if (prepared.facts.scope == Scope::PerSet && sets > 1 && !names_set) {
    mistakes.add(choice.place,
                 fmt::format("out: '{}' is one file for {} texture sets; expected '{{set}}' in it",
                             choice.out, sets));
  }
}

std::string task_title(const Plan& plan, const Task& task) {
  if (!task.set) return fmt::format("bake '{}'", task.bake);
  return fmt::format("bake '{}' of set '{}'", task.bake, plan.sets[*task.set].name);
}

// Sorted by whole components, a folder comes right before what it holds.
void refuse_collisions(const Plan& plan, Mistakes& mistakes) {
  std::vector<const Task*> sorted;
  for (const Task& task : plan.tasks) sorted.push_back(&task);
  std::stable_sort(sorted.begin(), sorted.end(), [](const Task* a, const Task* b) {
    const fs::path left(a->out == "." ? "" : a->out), right(b->out == "." ? "" : b->out);
    return left < right;
  });
  for (size_t i = 1, holder = 0; i < sorted.size(); ++i) {
    if (!collide(sorted[holder]->out, sorted[i]->out)) {
      holder = i;
      continue;
    }
    const Task &a = *sorted[holder], &b = *sorted[i];
    const std::string clash = a.out == b.out
                                  ? fmt::format("both write '{}'", a.out)
                                  : fmt::format("write '{}' and, inside it, '{}'", a.out, b.out);
    mistakes.add({}, fmt::format("two tasks have one output: {} and {} {}", task_title(plan, a),
                                 task_title(plan, b), clash));
  }
}

void check_display(const ColorConfig& config, const Task& task) {
  const auto& [display, view, exposure] = task.output.display;
  const std::vector<std::string> displays = config.displays();
  if (!display.empty() && !std::count(displays.begin(), displays.end(), display)) {
    throw Error(Fault::Usage, unknown_name("display", display, displays));
  }
  const std::vector<std::string> views =
      config.views(display.empty() ? config.default_display() : display);
  if (!view.empty() && !std::count(views.begin(), views.end(), view)) {
    throw Error(Fault::Usage, unknown_name("view transform", view, views));
  }
}

void check_colors(const Pipeline& pipeline, const std::vector<Prepared>& bakes, Plan& plan,
                  Mistakes& mistakes) {
  const ColorConfig config(plan.color.config);
  const auto resolve = [&](const std::string& space, const Place& place) {
    if (!space.empty()) attempt(mistakes, place, [&] { config.resolve(space); });
  };
  resolve(plan.color.working, {});
  for (const EnvironmentChoice& environment : plan.environments) {
    resolve(environment.color_space, environment.place);
  }
  for (const SetChoice& set : pipeline.sets) {
    for (const MapChoice& map : set.maps) resolve(map.color_space, map.place);
  }
  for (const Prepared& prepared : bakes) {
    attempt(mistakes, prepared.choice.place, [&] { check_display(config, prepared.task); });
  }
}

}  // namespace

std::vector<PlannedSet> planned_sets(const Pipeline& pipeline) {
  Plan plan;
  Mistakes mistakes;
  plan_sets(pipeline, plan, mistakes);
  mistakes.raise();
  return std::move(plan.sets);
}

Plan make_plan(const Pipeline& pipeline, const fs::path& output) {
  Plan plan;
  plan.file = pipeline.file;
  plan.name = pipeline.name;
  plan.output = output;
  plan.color = pipeline.color;
  plan.color.config = chosen_config("", pipeline.color.config);
  plan.max_memory = pipeline.max_memory;
  plan.material = pipeline.material;
  plan.environments = pipeline.environments;

  Mistakes mistakes;
  plan_sets(pipeline, plan, mistakes);
  attempt(mistakes, plan.material.place, [&] { check_surface(plan.material.surface); });
  std::vector<Prepared> bakes;
  for (const BakeChoice& choice : pipeline.bakes) {
    attempt(mistakes, choice.place, [&] { bakes.push_back(prepare(pipeline, choice, mistakes)); });
  }
  check_colors(pipeline, bakes, plan, mistakes);
  for (const Prepared& prepared : bakes) {
    check_scope(prepared, pipeline, plan.sets.size(), mistakes);
  }
  mistakes.raise();

  for (const Prepared& prepared : bakes) {
    if (prepared.facts.scope == Scope::Once) add_task(prepared, std::nullopt, plan, mistakes);
  }
  add_tasks_of_sets(bakes, plan, mistakes);
  mistakes.raise();
  refuse_collisions(plan, mistakes);
  mistakes.raise();
  return plan;
}

Plan only(Plan plan, const std::vector<std::string>& patterns) {
  if (patterns.empty()) return plan;
  std::vector<bool> used(patterns.size(), false);
  std::erase_if(plan.tasks, [&](const Task& task) {
    bool wanted = false;
    for (size_t i = 0; i < patterns.size(); ++i) {
      const bool fits = matches(patterns[i], task.out) ||
                        (task.set && matches(patterns[i], plan.sets[*task.set].name));
      used[i] = used[i] || fits;
      wanted = wanted || fits;
    }
    return !wanted;
  });
  std::vector<std::string> known;
  for (const PlannedSet& set : plan.sets) known.push_back(set.name);
  for (size_t i = 0; i < patterns.size(); ++i) {
    if (!used[i]) {
      throw Error(Fault::Usage, "--only: " + unknown_name("set or output", patterns[i], known));
    }
  }
  return plan;
}

fs::path default_output(const fs::path& pipeline_file) {
  return pipeline_file.parent_path() / "out";
}

}  // namespace kiln

// SPDX-License-Identifier: Apache-2.0
#include "one_bake.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "console.h"
#include "interruption.h"
#include "kiln/core/error.h"
#include "kiln/core/find_named.h"
#include "kiln/pipeline/schema.h"

namespace kiln {
namespace {

namespace fs = std::filesystem;

// All choices, or the first of many: kiln list has the rest.
std::string listed(const std::vector<std::string>& choices) {
  constexpr size_t most = 7;
  if (choices.size() <= most) return fmt::format("{}", fmt::join(choices, ", "));
  return fmt::format("{}, ... (kiln list)", fmt::join(choices.begin(), choices.begin() + 4, ", "));
}

std::string described(const ParamFacts& facts) {
  std::string text = facts.meaning;
  if (!facts.unit.empty()) text += " " + facts.unit;
  if (!facts.choices.empty()) text += ": " + listed(facts.choices);
  const bool shown = !facts.default_text.empty() && facts.kind != ParamFacts::Kind::Flag;
  if (shown) text += fmt::format(" (default {})", facts.default_text);
  return text;
}

std::string placeholder(const ParamFacts& facts) {
  switch (facts.kind) {
    case ParamFacts::Kind::Flag:
      return "";
    case ParamFacts::Kind::Integer:
      return "N";
    case ParamFacts::Kind::Number:
      return "X";
    case ParamFacts::Kind::Word:
      return "WORD";
    case ParamFacts::Kind::Extent:
      return "N|WxH";
    case ParamFacts::Kind::Text:
      return "TEXT";
  }
  return "";
}

const BakeFacts& facts_of_bake(const std::string& bake) {
  return find_named(all_bakes(), "bake", bake);
}

void print_task(const fs::path& folder, const TaskRecord& task) {
  for (const std::string& output : task.outputs) {
    fmt::print("{}\n", (folder / output).lexically_normal().string());
  }
  size_t width = 0;
  for (const auto& figure : task.figures) width = std::max(width, figure.first.size());
  for (const auto& [name, value] : task.figures) {
    fmt::print("  {:<{}}  {:.4g}\n", name, width, value);
  }
}

void print_notes(const Report& report) {
  const auto print = [](const std::vector<std::string>& notes) {
    for (const std::string& note : notes) fmt::print(stderr, "note: {}\n", note);
  };
  for (const SetRecord& set : report.sets) fmt::print(stderr, "{}\n", told(set));
  for (const EnvironmentRecord& light : report.environments) {
    fmt::print(stderr, "{}\n", told(light));
  }
  for (const TaskRecord& task : report.tasks) print(task.notes);
}

// The output folder is what is sure to be one: all before a file's name, and before the first part
// that names sets or maps. The bake's output is the rest.
fs::path name_output(BakeChoice& bake, const std::string& output) {
  const Product product = facts_of_bake(bake.bake).product;
  const fs::path path(output);
  const bool has_names = output.find('{') != std::string::npos;
  const bool is_folder =
      product == Product::Folder || (product == Product::Maps && !path.has_extension());
  if (is_folder && !has_names) {
    bake.out = ".";
    return output;
  }
  fs::path folder, rest;
  auto part = path.begin();
  for (; std::next(part) != path.end() && part->string().find('{') == std::string::npos; ++part) {
    folder /= *part;
  }
  for (; part != path.end(); ++part) rest /= *part;
  bake.out = rest.string();
  return folder.empty() ? "." : folder;
}

}  // namespace

BakeOptions::BakeOptions(CLI::App& app, const std::string& bake,
                         const std::vector<std::string>& except)
    : bake_(bake) {
  for (const Key& key : bake_block(facts_of_bake(bake)).keys) {
    const std::string& name = key.facts.name;
    if (name == "bake" || name == "out" || name == "env") continue;
    if (!std::count(except.begin(), except.end(), name)) declare(app, key.facts);
  }
}

void BakeOptions::declare(CLI::App& app, const ParamFacts& facts) {
  const auto option = std::make_shared<Option>();
  option->key = facts.name;
  const std::string name = "--" + kebab(facts.name);
  if (facts.kind == ParamFacts::Kind::Flag) {
    option->option = app.add_flag(name + "{true}", option->text, described(facts));
  } else {
    option->option = app.add_option(name, option->text, described(facts));
    option->option->type_name(placeholder(facts));
  }
  options_.push_back(option);
}

BakeChoice BakeOptions::choice(std::vector<std::pair<std::string, std::string>> keys) const {
  keys.emplace_back("bake", bake_);
  keys.emplace_back("out", "output");
  for (auto& key : given()) keys.push_back(std::move(key));
  return bake_choice(keys);
}

std::vector<std::pair<std::string, std::string>> BakeOptions::given() const {
  std::vector<std::pair<std::string, std::string>> keys;
  for (const auto& option : options_) {
    if (option->option->count() > 0) keys.emplace_back(option->key, option->text);
  }
  return keys;
}

int run_one_bake(Pipeline pipeline, const std::string& output, const Globals& globals) {
  if (output.empty()) throw Error(Fault::Usage, "no output is given: -o FILE, or -o DIR");
  const Interruption interruption;
  pipeline.color.config = chosen_config(globals.ocio, pipeline.color.config);
  const fs::path folder = name_output(pipeline.bakes.at(0), output);
  Plan plan = make_plan(pipeline, folder);
  plan.max_memory = globals.max_memory;
  const bool is_alone = plan.tasks.size() == 1;
  Watcher watcher = console_watcher(ProgressStyle::None, globals);
  watcher.loaded = {};
  watcher.lit = {};
  if (is_alone) watcher.ended = {};
  watcher.interrupted = [&] { return interruption.signal(); };
  const Report report = run_plan(plan, Records::None, watcher);
  if (!globals.quiet) print_notes(report);
  if (report.signal != 0) return exit_code(report);
  if (is_alone && report.tasks.at(0).fault) throw Error(*report.tasks.at(0).fault);
  if (globals.json) {
    fmt::print("{}", report_json(report));
  } else if (!globals.quiet) {
    for (const TaskRecord& task : report.tasks) print_task(folder, task);
  }
  return exit_code(report);
}

}  // namespace kiln

// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

#include "help.h"
#include "kiln/core/error.h"
#include "kiln/core/param.h"
#include "kiln/parallel/threads.h"
#include "kiln/pipeline/report.h"
#include "verb.h"

namespace kiln {
namespace {

struct RawGlobals {
  std::string threads, memory, isa = "auto", color = "auto";
  bool help = false;  ///< never read: asks_for_help() looks for it first
};

void declare_globals(CLI::App& app, Globals& globals, RawGlobals& raw) {
  app.add_flag("-h,--help", raw.help)->group(every_verb);
  app.add_flag("--json", globals.json)->group(every_verb);
  app.add_flag("-q,--quiet", globals.quiet)->group(every_verb);
  app.add_flag("-v,--verbose", globals.verbose)->group(every_verb);
  app.add_option("-j,--threads", raw.threads)->group(every_verb);
  app.add_option("--max-memory", raw.memory)->group(every_verb);
  app.add_option("--ocio", globals.ocio)->group(every_verb);
  app.add_option("--isa", raw.isa)->group(every_verb);
  app.add_option("--color", raw.color)->group(every_verb);
}

void check_globals(Globals& globals, const RawGlobals& raw) {
  if (!raw.threads.empty()) {
    ParamFacts facts;
    facts.name = "--threads";
    facts.min = 1;
    facts.max = 4096;
    globals.threads = static_cast<int>(parse_integer(facts, raw.threads));
  }
  if (!raw.memory.empty()) globals.max_memory = parse_bytes("--max-memory", raw.memory);
  if (const std::string isa = kebab(raw.isa); isa != "auto" && isa != "avx2") {
    throw Error(Fault::Usage,
                fmt::format("--isa: found '{}', this build holds avx2 (or auto)", raw.isa));
  }
  ParamFacts facts;
  facts.name = "--color";
  facts.choices = {"auto", "always", "never"};
  globals.color = facts.choices[parse_word(facts, raw.color)];
}

// "--color_space" is "--color-space".
void respell_options(std::vector<std::string>& arguments) {
  for (std::string& argument : arguments) {
    if (argument == "--") return;
    if (!argument.starts_with("--")) continue;
    const auto end =
        argument.begin() + static_cast<long>(std::min(argument.find('='), argument.size()));
    std::replace(argument.begin(), end, '_', '-');
  }
}

std::vector<std::string> option_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

void refuse_extras(const CLI::App& app) {
  const std::vector<std::string> extras = app.remaining();
  if (extras.empty()) return;
  const auto option = std::find_if(extras.begin(), extras.end(),
                                   [](const std::string& text) { return text.starts_with("-"); });
  if (option == extras.end()) {
    throw Error(Fault::Usage, fmt::format("unexpected argument '{}'", extras.front()));
  }
  const std::string name = option->substr(0, option->find('='));
  const auto nearest = nearest_name(name, option_names(app));
  throw Error(Fault::Usage,
              nearest ? fmt::format("unknown option '{}' (did you mean '{}'?)", name, *nearest)
                      : fmt::format("unknown option '{}' (see {} --help)", name, app.get_name()));
}

const Verb* find_verb(const std::vector<Verb>& verbs, const std::string& name) {
  for (const Verb& verb : verbs) {
    if (verb.name == name) return &verb;
  }
  return nullptr;
}

[[noreturn]] void refuse_verb(const std::vector<Verb>& verbs, const std::string& word) {
  if (word.starts_with("-")) {
    throw Error(Fault::Usage,
                fmt::format("expected a verb first, found '{}' (see kiln --help)", word));
  }
  std::vector<std::string> names;
  names.reserve(verbs.size());
  for (const Verb& verb : verbs) names.push_back(verb.name);
  throw Error(Fault::Usage, unknown_name("verb", word, names));
}

bool asks_for_help(const std::vector<std::string>& arguments) {
  const auto end = std::find(arguments.begin(), arguments.end(), "--");
  return std::any_of(arguments.begin(), end,
                     [](const std::string& text) { return text == "--help" || text == "-h"; });
}

int run_one(const Verb& verb, std::vector<std::string> arguments) {
  CLI::App app(verb.summary, "kiln " + verb.name);
  app.set_help_flag();
  app.allow_extras();
  Globals globals;
  RawGlobals raw;
  const Action action = verb.declare(app);
  declare_globals(app, globals, raw);
  if (asks_for_help(arguments)) {
    fmt::print("{}", help_of(verb, app));
    return 0;
  }
  respell_options(arguments);
  std::reverse(arguments.begin(), arguments.end());  // the order that CLI::App wants
  app.parse(arguments);
  refuse_extras(app);
  check_globals(globals, raw);
  const ThreadLimit limit(globals.threads > 0 ? globals.threads : available_threads());
  return action(globals);
}

}  // namespace

std::vector<Verb> all_verbs() {
  return {run_verb(),  lut_verb(),     verify_verb(), env_verb(), preview_verb(),
          bake_verb(), inspect_verb(), diff_verb(),   list_verb()};
}

int run_command(std::vector<std::string> arguments) {
  if (arguments.empty()) {
    fmt::print(stderr, "{}", overview());
    return exit_code(Fault::Usage);
  }
  const std::string first = arguments.front();
  if (first == "--help" || first == "-h" || first == "help") {
    fmt::print("{}", overview());
    return 0;
  }
  if (first == "--version") {
    fmt::print("{}\n", software());
    return 0;
  }
  const std::vector<Verb> verbs = all_verbs();
  const Verb* verb = find_verb(verbs, first);
  if (!verb) refuse_verb(verbs, first);
  arguments.erase(arguments.begin());
  if (verb->narrowed && !arguments.empty() && !arguments.front().starts_with("-")) {
    const Verb narrowed = verb->narrowed(arguments.front());
    arguments.erase(arguments.begin());
    return run_one(narrowed, std::move(arguments));
  }
  return run_one(*verb, std::move(arguments));
}

}  // namespace kiln

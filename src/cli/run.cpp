// SPDX-License-Identifier: Apache-2.0
#include "kiln/pipeline/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <memory>

#include "console.h"
#include "interruption.h"
#include "kiln/core/error.h"
#include "verb.h"

namespace kiln {
namespace {

struct RunArguments {
  std::string pipeline, output, progress = "auto";
  std::vector<std::string> vars, only;
  bool dry_run = false;
};

using Pairs = std::vector<std::pair<std::string, std::string>>;

Pairs split_vars(const std::vector<std::string>& texts) {
  Pairs pairs;
  for (const std::string& text : texts) {
    const size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0) {
      throw Error(Fault::Usage, fmt::format("--set: found '{}', expected key=value", text));
    }
    pairs.emplace_back(text.substr(0, equals), text.substr(equals + 1));
  }
  return pairs;
}

bool is_plain(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) ||
         std::string_view("_-./=:,").find(c) != std::string_view::npos;
}

std::string quoted(const std::string& word) {
  if (!word.empty() && std::all_of(word.begin(), word.end(), is_plain)) return word;
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? "'\\''" : std::string(1, c);
  return text + "'";
}

std::string retry_command(const RunArguments& arguments, const Globals& globals,
                          const Report& report) {
  std::string command = "kiln run " + quoted(arguments.pipeline);
  if (!arguments.output.empty()) command += " -o " + quoted(arguments.output);
  if (!globals.ocio.empty()) command += " --ocio " + quoted(globals.ocio);
  for (const std::string& var : arguments.vars) command += " --set " + quoted(var);
  for (const std::string& pattern : retry_patterns(report)) {
    command += " --only " + quoted(pattern);
  }
  return command;
}

void print_result(const RunArguments& arguments, const Globals& globals, const Report& report) {
  if (globals.json) {
    fmt::print("{}", report_json(report));
  } else if (!globals.quiet) {
    fmt::print("{}", summary_table(report));
  }
  if (!retry_patterns(report).empty() && !globals.quiet) {
    fmt::print(stderr, "to retry: {}\n", retry_command(arguments, globals, report));
  }
}

int run(const RunArguments& arguments, const Globals& globals) {
  if (arguments.pipeline.empty()) throw Error(Fault::Usage, "expected a PIPELINE file");
  const ProgressStyle style = progress_style(arguments.progress, globals);
  const Interruption interruption;
  Pipeline pipeline = read_pipeline(arguments.pipeline, split_vars(arguments.vars));
  pipeline.color.config = chosen_config(globals.ocio, pipeline.color.config);
  const std::filesystem::path output = arguments.output.empty()
                                           ? default_output(pipeline.file)
                                           : std::filesystem::path(arguments.output);
  Plan plan = only(make_plan(pipeline, output), arguments.only);
  if (globals.max_memory > 0) plan.max_memory = globals.max_memory;
  Watcher watcher = console_watcher(style, globals);
  if (arguments.dry_run) {
    for (const std::string& warning : plan.warnings) watcher.warned(warning);
    fmt::print("{}", globals.json ? dry_run_json(plan) : dry_run_table(plan));
    return 0;
  }
  watcher.interrupted = [&] { return interruption.signal(); };
  const Report report = run_plan(plan, Records::Keep, watcher);
  print_result(arguments, globals, report);
  return exit_code(report);
}

Action declare(CLI::App& app) {
  const auto arguments = std::make_shared<RunArguments>();
  app.add_option("PIPELINE", arguments->pipeline, "pipeline file, YAML or JSON")->type_name("");
  app.add_option("-o,--output", arguments->output, "output folder (default: out beside PIPELINE)")
      ->type_name("DIR");
  app.add_option("--set", arguments->vars, "another value for one of the file's vars; repeatable")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  app.add_option("--only", arguments->only, "only tasks whose set or output matches; repeatable")
      ->type_name("GLOB")
      ->allow_extra_args(false);
  app.add_flag("--dry-run", arguments->dry_run, "print the tasks and their outputs, bake nothing");
  app.add_option("--progress", arguments->progress, "auto, tty, plain, json or none")
      ->type_name("WORD");
  return [arguments](const Globals& globals) { return run(*arguments, globals); };
}

}  // namespace

Verb run_verb() { return {"run", "PIPELINE", "bake everything a pipeline file asks for", declare}; }

}  // namespace kiln

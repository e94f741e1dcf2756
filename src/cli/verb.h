// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <vector>

namespace kiln {

/// The options that every verb takes.
struct Globals {
  bool json = false;
  bool quiet = false;
  bool verbose = false;
  int threads = 0;           ///< 0: as many as the process may use
  long long max_memory = 0;  ///< [byte] that the process may take; 0: no limit
  std::string ocio;
  std::string color = "auto";
};

/// What a verb does once its arguments are read. Returns the exit code.
using Action = std::function<int(const Globals&)>;

struct Verb {
  std::string name;
  std::string arguments;  ///< "PIPELINE"
  std::string summary;
  /// Declares the verb's arguments and returns what to do with them.
  std::function<Action(CLI::App&)> declare;
  /// Of a verb whose first argument decides the others: the verb that it amounts to.
  std::function<Verb(const std::string& word)> narrowed = {};
};

Verb run_verb();
Verb lut_verb();
Verb verify_verb();
Verb env_verb();
Verb preview_verb();
Verb bake_verb();
Verb inspect_verb();
Verb diff_verb();
Verb list_verb();

/// Every verb there is, in the order of the help.
std::vector<Verb> all_verbs();

/// Runs the command: argument 0 is the verb.
/// @error Error, or CLI::ParseError for options that do not parse
int run_command(std::vector<std::string> arguments);

}  // namespace kiln

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "kiln/pipeline/run.h"
#include "verb.h"

namespace kiln {

/// Options made from the keys of a bake: its parameters, and how its files are written.
class BakeOptions {
 public:
  /// Declares an option for every key except those named.
  BakeOptions(CLI::App& app, const std::string& bake, const std::vector<std::string>& except);

  /// The bake with what was given, its output still to be named.
  /// @param keys  what the verb itself decided
  /// @error Fault::Usage naming the parameter
  BakeChoice choice(std::vector<std::pair<std::string, std::string>> keys) const;

  /// The keys that were given, and their texts.
  std::vector<std::pair<std::string, std::string>> given() const;

 private:
  struct Option {
    std::string key;
    std::string text;
    CLI::Option* option = nullptr;
  };
  void declare(CLI::App& app, const ParamFacts& facts);

  std::string bake_;
  std::vector<std::shared_ptr<Option>> options_;
};

/// Runs a pipeline of one bake, of one texture set or of several, and prints what came of it.
/// @param output  file or folder, as the user wrote it
/// @error Fault::Usage when no output is given; of a single task its own fault
int run_one_bake(Pipeline pipeline, const std::string& output, const Globals& globals);

}  // namespace kiln

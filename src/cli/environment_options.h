// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "kiln/pipeline/pipeline.h"
#include "verb.h"

namespace kiln {

/// How an environment is read, as options: the keys of an `environment` block.
struct EnvironmentOptions {
  std::string path;
  std::vector<std::pair<std::string, std::string>> keys = {};  ///< all but `path`; empty: not given

  /// @param except  keys that are left to others
  /// @param group   of the options in the help
  void declare(CLI::App& app, const std::vector<std::string>& except = {},
               const std::string& group = "Options");

  /// The environment named "env".
  /// @error Fault::Usage naming the option
  EnvironmentChoice choice() const;
};

}  // namespace kiln

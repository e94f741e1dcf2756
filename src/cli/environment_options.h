// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "kiln/pipeline/pipeline.h"
#include "verb.h"

namespace kiln {

/// How an environment image is read, as options: the keys of an `environment` block.
struct EnvironmentOptions {
  std::string path, color_space, rotate, fix;

  /// @param with_rotate  "--rotate", or empty where the bake has its own
  void declare(CLI::App& app, const std::string& with_rotate);

  /// The environment named "env".
  EnvironmentChoice choice() const;
};

}  // namespace kiln

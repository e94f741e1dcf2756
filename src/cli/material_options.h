// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "kiln/pipeline/plan.h"
#include "verb.h"

namespace kiln {

/// A MATERIAL on the command line: a folder of maps, a material file, a glTF or MaterialX document,
/// or a packed image, and how to read it.
struct MaterialOptions {
  std::string path, name, packed;
  std::vector<std::string> naming;
  std::vector<std::pair<std::string, std::string>> reading;  ///< keys of the set's block

  std::vector<std::pair<std::string, std::string>> models;  ///< keys of the material block

  void declare(CLI::App& app);

  /// Options for the models that the maps feed.
  void declare_models(CLI::App& app);

  /// Puts the sets of this material, and its model, into the pipeline.
  /// @error Fault::Usage for unknown words, Fault::Input when the file cannot be read
  void add_to(Pipeline& pipeline) const;
};

/// @error Fault::Usage that lists the texture sets when there are several and the output has no
/// {set} or {udim} to tell their files apart
void require_names_for_sets(const Pipeline& pipeline, const std::string& output);

}  // namespace kiln

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace kiln {

/// A kind of file that environments are written as.
struct EnvironmentFormat {
  std::string name;       ///< as a user states it
  std::string extension;  ///< with dot
  std::string meaning;
  bool whole;                          ///< all levels and faces in one file
  bool at_nodes;                       ///< samples on the borders
  std::vector<std::string> encodings;  ///< pixel types; the first is the default
  bool supercompresses = false;
};
const std::vector<EnvironmentFormat>& all_environment_formats();

/// How an engine wants an environment: data, no code. A new one is one entry on the list.
struct EnvironmentPreset {
  std::string name;
  std::string summary;
  std::vector<std::pair<std::string, std::string>> settings;     ///< as a user would write them
  std::string specular = "specular", irradiance = "irradiance";  ///< names of files
  std::string skybox;                 ///< of level 0 alone; empty: not made
  std::vector<std::string> cautions;  ///< what a user of the engine should know
};
const std::vector<EnvironmentPreset>& all_environment_presets();
std::vector<std::string> environment_preset_names();

/// @error Fault::Usage, naming the nearest known name
const EnvironmentFormat& find_environment_format(const std::string& name);
const EnvironmentPreset& find_environment_preset(const std::string& name);

}  // namespace kiln

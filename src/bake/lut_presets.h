// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace kiln {

/// How an engine wants a table: data, no code. A new one is one entry on the list.
struct LutPreset {
  struct Table {
    std::string table;
    std::vector<std::pair<std::string, std::string>> settings;  ///< as a user would write them
  };
  std::string name;
  std::string summary;
  std::string pixel_type;             ///< "half", where the file's format holds it
  std::vector<Table> tables;          ///< the first is the one the preset is known for
  std::vector<std::string> cautions;  ///< how the engine's own table differs, and why this one does
};

const std::vector<LutPreset>& all_lut_presets();
std::vector<std::string> lut_preset_names();

/// The settings of a preset for a table.
/// @error Fault::Usage for an unknown preset, or one that has no such table
const LutPreset& find_lut_preset(const std::string& name);
const LutPreset::Table& preset_table(const LutPreset& preset, const std::string& table);

}  // namespace kiln

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace kiln::test {

/// One room of the floor plan: on which floor, and which rooms it may include.
struct Room {
  int floor = 0;
  std::vector<std::string> may_include;
};
using Plan = std::map<std::string, Room>;

/// A text file of the project.
struct Source {
  std::string path;                ///< from the project's root, with '/'
  std::vector<std::string> lines;  ///< line n is lines[n - 1]

  /// The room whose include/kiln/<room> or src/<room> holds it, or "".
  std::string room() const;
  bool is_public_header() const;
};

/// What the rules look at: the plan that CMake declares, and the tree.
struct House {
  Plan plan;
  Plan drawing;  ///< the same, as docs/architecture.md tells it
  std::vector<Source> sources;
  std::vector<std::string> room_folders;  ///< names below src and include/kiln
};

/// @param text  lines "<floor> <room>: <rooms it may include>"
Plan parse_plan(const std::string& text);

/// The plan as docs/architecture.md draws it: rows "| floor | `room` | one line | may include |".
Plan parse_drawing(const std::vector<std::string>& lines);

/// @param root  the project's folder
/// @param plan  the file that CMake wrote the floor plan to
House read_house(const std::filesystem::path& root, const std::filesystem::path& plan);

}  // namespace kiln::test

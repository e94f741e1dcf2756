// SPDX-License-Identifier: Apache-2.0
#include "house.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <sstream>

namespace kiln::test {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> lines_of(const fs::path& file) {
  std::ifstream stream(file);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

bool is_source(const fs::path& file) {
  static const std::set<std::string> kinds = {".h", ".cpp", ".cmake", ".sh"};
  return kinds.contains(file.extension().string()) || file.filename() == "CMakeLists.txt" ||
         file.parent_path().filename() == ".ci";
}

void read_folder(const fs::path& root, const std::string& folder, std::vector<Source>& sources) {
  if (!fs::is_directory(root / folder)) return;
  for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
    if (!entry.is_regular_file() || !is_source(entry.path())) continue;
    sources.push_back({fs::relative(entry.path(), root).generic_string(), lines_of(entry.path())});
  }
}

std::vector<std::string> folders_below(const fs::path& root) {
  std::vector<std::string> names;
  for (const char* parent : {"src", "include/kiln"}) {
    for (const auto& entry : fs::directory_iterator(root / parent)) {
      if (entry.is_directory()) names.push_back(entry.path().filename().string());
    }
  }
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

}  // namespace

std::string Source::room() const {
  for (const std::string parent : {"include/kiln/", "src/"}) {
    if (!path.starts_with(parent)) continue;
    const size_t end = path.find('/', parent.size());
    if (end != std::string::npos) return path.substr(parent.size(), end - parent.size());
  }
  return "";
}

bool Source::is_public_header() const { return path.starts_with("include/kiln/"); }

Plan parse_plan(const std::string& text) {
  Plan plan;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) {
    std::istringstream words(line);
    Room room;
    std::string name;
    if (!(words >> room.floor >> name)) continue;
    name.pop_back();  // the colon
    for (std::string used; words >> used;) room.may_include.push_back(used);
    plan[name] = room;
  }
  return plan;
}

Plan parse_drawing(const std::vector<std::string>& lines) {
  static const std::regex row(R"(^\| (\d+) \| `(\w+)` \|[^|]*\| ([^|]*) \|$)");
  Plan plan;
  for (const std::string& line : lines) {
    std::smatch match;
    if (!std::regex_search(line, match, row)) continue;
    Room room{std::stoi(match[1]), {}};
    std::string used = match[3];
    std::replace(used.begin(), used.end(), ',', ' ');
    std::istringstream words(used);
    for (std::string word; words >> word;) {
      if (word != "-") room.may_include.push_back(word);
    }
    plan[match[2]] = room;
  }
  return plan;
}

House read_house(const fs::path& root, const fs::path& plan) {
  std::ifstream stream(plan);
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  House house{parse_plan(text),
              parse_drawing(lines_of(root / "docs" / "architecture.md")),
              {},
              folders_below(root)};
  for (const char* folder :
       {"include", "src", "tests", "bench", "textures", "cmake", "scripts", ".ci"}) {
    read_folder(root, folder, house.sources);
  }
  house.sources.push_back({"CMakeLists.txt", lines_of(root / "CMakeLists.txt")});
  std::sort(house.sources.begin(), house.sources.end(),
            [](const Source& a, const Source& b) { return a.path < b.path; });
  return house;
}

}  // namespace kiln::test

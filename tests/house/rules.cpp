// SPDX-License-Identifier: Apache-2.0
#include "rules.h"

#include <algorithm>
#include <functional>
#include <map>
#include <regex>
#include <set>
#include <sstream>

namespace kiln::test {
namespace {

using Names = std::set<std::string>;

std::string at(const Source& source, size_t line) {
  return source.path + ":" + std::to_string(line + 1) + ": ";
}

std::string joined(const Names& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text.empty() ? "none" : text;
}

/// The header that a line includes, with its bracket or quote: `<vector`, `"kiln/core/error.h`.
std::string included(const std::string& line) {
  static const std::regex pattern(R"(^\s*#\s*include\s*([<"][^>"]+)[>"])");
  std::smatch match;
  return std::regex_search(line, match, pattern) ? match[1].str() : "";
}

/// The line without its `//` comment and without what stands in quotes.
std::string code_of(const std::string& line) {
  static const std::regex quoted(R"re("(?:[^"\\]|\\.)*")re");
  const std::string plain = std::regex_replace(line, quoted, "\"\"");
  return plain.substr(0, plain.find("//"));
}

/// Every line of the rooms, with the room it belongs to.
void for_room_lines(const House& house,
                    const std::function<void(const Source&, size_t, const std::string&)>& look) {
  for (const Source& source : house.sources) {
    if (source.room().empty() || source.path.ends_with("CMakeLists.txt")) continue;
    for (size_t i = 0; i < source.lines.size(); ++i) look(source, i, source.lines[i]);
  }
}

Names allowed_rooms(const House& house, const std::string& room) {
  const auto found = house.plan.find(room);
  if (found == house.plan.end()) return {};
  Names names(found->second.may_include.begin(), found->second.may_include.end());
  names.insert(room);
  return names;
}

/// Where third-party headers may be included. A header belongs to the first beginning it matches.
struct ThirdParty {
  std::string beginning;
  Names rooms;
};
const std::vector<ThirdParty> third_parties = {
    {"OpenImageIO/", {"io"}},    {"OpenEXR/", {"io"}},
    {"Imath/", {"io"}},          {"Imf", {"io"}},
    {"OpenColorIO/", {"color"}}, {"tbb/", {"parallel"}},
    {"oneapi/", {"parallel"}},   {"yaml-cpp/", {"pipeline"}},
    {"CLI/", {"cli"}},           {"nlohmann/", {"pipeline", "cli", "bake", "light", "table", "io"}},
    {"xsimd/", {"math"}},        {"xxhash.h", {"store"}},
    {"zstd.h", {"io"}},          {"pugixml.hpp", {"pipeline"}},
};

/// Files that may catch: where an exception of a third party, or of a task, is turned into ours,
/// and where the mistakes of a pipeline file are gathered.
bool may_catch(const Source& source) {
  static const Names rooms = {"io", "color", "parallel", "store"};
  static const Names files = {"include/kiln/core/error.h", "src/cli/main.cpp"};
  static const std::regex runner(R"(^(src|include/kiln)/pipeline/(run\w*|document)\.(cpp|h)$)");
  return rooms.contains(source.room()) || files.contains(source.path) ||
         std::regex_search(source.path, runner);
}

void visit(const House& house, const std::string& room, std::vector<std::string>& path, Names& done,
           Breaches& breaches) {
  const auto seen = std::find(path.begin(), path.end(), room);
  if (seen != path.end()) {
    std::string circle;
    for (auto step = seen; step != path.end(); ++step) circle += *step + " -> ";
    breaches.push_back("house.txt: " + circle + room);
    return;
  }
  const auto found = house.plan.find(room);
  if (done.contains(room) || found == house.plan.end()) return;
  path.push_back(room);
  for (const std::string& used : found->second.may_include)
    visit(house, used, path, done, breaches);
  path.pop_back();
  done.insert(room);
}

}  // namespace

Breaches includes_that_the_plan_forbids(const House& house) {
  static const std::regex of_room("^\"kiln/([^/]+)/");
  Breaches breaches;
  for_room_lines(house, [&](const Source& source, size_t i, const std::string& line) {
    const std::string header = included(line);
    std::smatch match;
    if (header.starts_with("\".."))
      breaches.push_back(at(source, i) + "includes across folders: " + header.substr(1));
    if (!std::regex_search(header, match, of_room)) return;
    const Names allowed = allowed_rooms(house, source.room());
    if (allowed.contains(match[1])) return;
    breaches.push_back(at(source, i) + source.room() + " includes " + match[1].str() +
                       "; it may include " + joined(allowed));
  });
  return breaches;
}

Breaches arrows_that_point_up(const House& house) {
  Breaches breaches;
  for (const auto& [name, room] : house.plan) {
    for (const std::string& used : room.may_include) {
      const auto below = house.plan.find(used);
      if (below == house.plan.end()) {
        breaches.push_back("house.txt: " + name + " may include " + used + ", which is no room");
      } else if (below->second.floor > room.floor) {
        breaches.push_back("house.txt: " + name + " on floor " + std::to_string(room.floor) +
                           " may include " + used + " on floor " +
                           std::to_string(below->second.floor));
      }
    }
  }
  return breaches;
}

Breaches rooms_in_a_cycle(const House& house) {
  Breaches breaches;
  Names done;
  for (const auto& [name, room] : house.plan) {
    std::vector<std::string> path;
    visit(house, name, path, done, breaches);
  }
  return breaches;
}

Breaches rooms_missing_from_plan_or_disk(const House& house) {
  Breaches breaches;
  const Names folders(house.room_folders.begin(), house.room_folders.end());
  for (const std::string& folder : folders) {
    if (!house.plan.contains(folder)) {
      breaches.push_back("src/" + folder + ":1: a folder without kiln_room(" + folder + " ...)");
    }
  }
  for (const auto& [name, room] : house.plan) {
    if (!folders.contains(name)) breaches.push_back("house.txt: room " + name + " has no folder");
  }
  return breaches;
}

Breaches rooms_drawn_otherwise(const House& house) {
  const auto told = [](const Plan& plan, const std::string& name) {
    const auto found = plan.find(name);
    if (found == plan.end()) return std::string("nothing");
    const auto& used = found->second.may_include;
    return "floor " + std::to_string(found->second.floor) + ", " +
           joined({used.begin(), used.end()});
  };
  Names names;
  for (const Plan* plan : {&house.plan, &house.drawing}) {
    for (const auto& [name, room] : *plan) names.insert(name);
  }
  Breaches breaches;
  for (const std::string& name : names) {
    const std::string built = told(house.plan, name), drawn = told(house.drawing, name);
    if (built == drawn) continue;
    breaches.push_back("docs/architecture.md: " + name + " is drawn as " + drawn + "; CMake says " +
                       built);
  }
  return breaches;
}

Breaches third_party_headers_outside_their_room(const House& house) {
  Breaches breaches;
  for_room_lines(house, [&](const Source& source, size_t i, const std::string& line) {
    const std::string header = included(line);
    if (header.empty()) return;
    for (const ThirdParty& party : third_parties) {
      if (!header.substr(1).starts_with(party.beginning)) continue;
      if (party.rooms.contains(source.room())) break;
      breaches.push_back(at(source, i) + "includes " + header.substr(1) + "; only " +
                         joined(party.rooms) + " may");
      break;
    }
  });
  return breaches;
}

Breaches third_party_types_in_public_headers(const House& house) {
  static const std::regex foreign(
      R"(\b(OIIO|OpenImageIO|OCIO|OpenColorIO|Imf|Imath|tbb|YAML|CLI|nlohmann|fmt|xsimd|pugi)::)");
  Breaches breaches;
  for_room_lines(house, [&](const Source& source, size_t i, const std::string& line) {
    if (!source.is_public_header() || source.path == "include/kiln/math/wide.h") return;
    const std::string header = included(line);
    const bool standard =
        header.starts_with("<") && header.find_first_of("/.") == std::string::npos;
    if (!header.empty() && !standard && !header.starts_with("\"kiln/")) {
      breaches.push_back(at(source, i) + "public header includes " + header.substr(1));
    }
    std::smatch match;
    const std::string code = code_of(line);
    if (std::regex_search(code, match, foreign)) {
      breaches.push_back(at(source, i) + "public header shows " + match[0].str());
    }
  });
  return breaches;
}

Breaches files_without_licence_line(const House& house) {
  Breaches breaches;
  for (const Source& source : house.sources) {
    const bool script = !source.lines.empty() && source.lines[0].starts_with("#!");
    const size_t line = script ? 1 : 0;
    const bool stands =
        source.lines.size() > line &&
        source.lines[line].find("SPDX-License-Identifier: Apache-2.0") != std::string::npos;
    if (!stands)
      breaches.push_back(at(source, line) + "expected SPDX-License-Identifier: Apache-2.0");
  }
  return breaches;
}

Breaches files_with_forbidden_names(const House& house) {
  static const Names everywhere = {"util", "utils",  "utility", "utilities", "common",
                                   "misc", "helper", "helpers", "manager"};
  static const Names in_rooms = {"data", "info", "process", "handle"};
  Breaches breaches;
  for (const Source& source : house.sources) {
    std::string path = source.path;
    std::replace_if(
        path.begin(), path.end(),
        [](char c) { return c == '_' || c == '-' || c == '/' || c == '.'; }, ' ');
    std::istringstream words(path);
    for (std::string word; words >> word;) {
      if (everywhere.contains(word) || (!source.room().empty() && in_rooms.contains(word))) {
        breaches.push_back(source.path + ":1: the name says '" + word + "': name what it is");
      }
    }
  }
  return breaches;
}

Breaches exits_and_prints_outside_the_command(const House& house) {
  static const std::regex pattern(
      R"((^|[^\w.>])(exit|_exit|quick_exit|abort|terminate|printf|fprintf|puts|fputs)\s*\(|std::(cout|cerr|clog)\b)");
  Breaches breaches;
  for_room_lines(house, [&](const Source& source, size_t i, const std::string& line) {
    if (source.room() == "cli") return;
    const std::string code = code_of(line);
    std::smatch match;
    if (std::regex_search(code, match, pattern)) {
      breaches.push_back(at(source, i) + "only cli ends the process or prints: " + match[0].str());
    }
  });
  return breaches;
}

Breaches catches_away_from_the_doors(const House& house) {
  static const std::regex pattern(R"(\bcatch\s*\()");
  Breaches breaches;
  for_room_lines(house, [&](const Source& source, size_t i, const std::string& line) {
    if (may_catch(source) || !std::regex_search(code_of(line), pattern)) return;
    breaches.push_back(at(source, i) + "catches; let the error rise, with_context() adds to it");
  });
  return breaches;
}

Breaches fast_math_flags(const House& house) {
  static const std::regex pattern(
      R"(-(ffast-math|Ofast|funsafe-math-optimizations|ffinite-math-only)\b)");
  Breaches breaches;
  for (const Source& source : house.sources) {
    if (!source.path.ends_with("CMakeLists.txt") && !source.path.ends_with(".cmake")) continue;
    for (size_t i = 0; i < source.lines.size(); ++i) {
      const std::string code = source.lines[i].substr(0, source.lines[i].find('#'));
      if (std::regex_search(code, pattern))
        breaches.push_back(at(source, i) + "NaN keeps meaning NaN: " + code);
    }
  }
  return breaches;
}

Breaches files_longer_than(const House& house, size_t limit) {
  Breaches long_files;
  for (const Source& source : house.sources) {
    if (source.room().empty() || source.lines.size() <= limit) continue;
    long_files.push_back(source.path + ": " + std::to_string(source.lines.size()) + " lines");
  }
  return long_files;
}

}  // namespace kiln::test

// SPDX-License-Identifier: Apache-2.0
#include "face_files.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <string_view>
#include <vector>

#include "glob.h"
#include "kiln/core/error.h"

namespace kiln {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view placeholder = "<FACE>";

using FaceNames = std::array<std::string_view, 6>;
constexpr std::array<FaceNames, 3> namings = {{
    {"px", "nx", "py", "ny", "pz", "nz"},
    {"posx", "negx", "posy", "negy", "posz", "negz"},
    {"right", "left", "top", "bottom", "front", "back"},
}};

std::string lower(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return result;
}

/// File names that differ in nothing but the face.
struct Group {
  std::string pattern;
  size_t naming = 0;
  std::array<std::string, 6> files;  ///< empty: missing

  long count() const { return 6 - std::count(files.begin(), files.end(), std::string()); }
};

class Groups {
 public:
  /// @param pattern  of the file's name, with <FACE> where the face stands
  void add(const std::string& pattern, size_t naming, size_t face, const std::string& file) {
    Group& group = groups_[{pattern, naming}];
    group.pattern = pattern;
    group.naming = naming;
    if (group.files[face].empty()) group.files[face] = file;
  }

  /// The one that is complete. @error Fault::Input when there is none, or more than one
  Group only(const std::string& none) const {
    std::vector<std::string> complete;
    const Group* best = nullptr;
    for (const auto& [key, group] : groups_) {
      if (group.count() == 6) complete.push_back(group.pattern);
      if (best == nullptr || group.count() > best->count()) best = &group;
    }
    if (best == nullptr) throw Error(Fault::Input, none);
    if (complete.empty()) refuse_missing(*best);
    if (complete.size() > 1) {
      throw Error(Fault::Input, fmt::format("{} sets of six faces, {}; expected one: name it",
                                            complete.size(), fmt::join(complete, ", ")));
    }
    return *best;
  }

 private:
  [[noreturn]] static void refuse_missing(const Group& group) {
    std::vector<std::string_view> missing;
    for (size_t face = 0; face < 6; ++face) {
      if (group.files[face].empty()) missing.push_back(namings[group.naming][face]);
    }
    throw Error(Fault::Input,
                fmt::format("of the six faces {}, {} of {} found; missing: {}", group.pattern,
                            group.count(), fmt::join(namings[group.naming], " "),
                            fmt::join(missing, ", ")));
  }

  std::map<std::pair<std::string, size_t>, Group> groups_;
};

// Calls use(naming, face, name) for every name of a face.
template <class Use>
void for_names(const Use& use) {
  for (size_t naming = 0; naming < namings.size(); ++naming) {
    for (size_t face = 0; face < 6; ++face) use(naming, face, namings[naming][face]);
  }
}

Groups groups_like(const fs::path& folder, const std::string& pattern) {
  const size_t at = pattern.find(placeholder);
  const std::string before = pattern.substr(0, at);
  const std::string after = pattern.substr(at + placeholder.size());
  Groups groups;
  for (const std::string& file : files_in(folder)) {
    if (file.size() <= before.size() + after.size()) continue;
    if (!file.starts_with(before) || !file.ends_with(after)) continue;
    const std::string between =
        lower(file.substr(before.size(), file.size() - before.size() - after.size()));
    for_names([&](size_t naming, size_t face, std::string_view name) {
      if (between == name) groups.add(pattern, naming, face, file);
    });
  }
  return groups;
}

Groups groups_in(const fs::path& folder) {
  Groups groups;
  for (const std::string& file : files_in(folder)) {
    const std::string stem = fs::path(file).stem().string();
    const std::string extension = fs::path(file).extension().string();
    for_names([&](size_t naming, size_t face, std::string_view name) {
      if (!lower(stem).ends_with(name)) return;
      std::string pattern = stem.substr(0, stem.size() - name.size());
      pattern.append(placeholder).append(extension);
      groups.add(pattern, naming, face, file);
    });
  }
  return groups;
}

FaceFiles found_in(const fs::path& folder, const Group& group) {
  FaceFiles found;
  for (size_t face = 0; face < 6; ++face) found.paths[face] = folder / group.files[face];
  found.pattern = group.pattern;
  found.naming = fmt::format("{}", fmt::join(namings[group.naming], " "));
  return found;
}

}  // namespace

std::optional<FaceFiles> face_files(const fs::path& path) {
  std::error_code failure;
  return with_context(path.string(), [&]() -> std::optional<FaceFiles> {
    const std::string name = path.filename().string();
    if (name.find(placeholder) != std::string::npos) {
      const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
      return found_in(folder, groups_like(folder, name).only("no such files"));
    }
    if (path.string().find(placeholder) != std::string::npos) {
      throw Error(Fault::Input, "<FACE> stands in the name of a folder, expected in the file's");
    }
    if (!fs::is_directory(path, failure)) return std::nullopt;
    return found_in(path, groups_in(path).only("a folder without a set of six faces"));
  });
}

}  // namespace kiln

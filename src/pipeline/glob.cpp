// SPDX-License-Identifier: Apache-2.0
#include "glob.h"

#include <algorithm>

namespace kiln {
namespace {

namespace fs = std::filesystem;

bool has_wildcard(std::string_view text) { return text.find_first_of("*?") != text.npos; }

std::vector<fs::path> subfolders(const fs::path& folder, const std::string& pattern) {
  std::vector<fs::path> found;
  std::error_code failure;
  const fs::path listed = folder.empty() ? fs::path(".") : folder;
  for (const fs::directory_entry& entry : fs::directory_iterator(listed, failure)) {
    const std::string name = entry.path().filename().string();
    const bool hidden = name.front() == '.' && pattern.front() != '.';
    if (!hidden && entry.is_directory(failure) && matches(pattern, name)) {
      found.push_back(folder / name);
    }
  }
  return found;
}

}  // namespace

// Greedy, with one place to come back to: the last star and where its match began.
bool matches(std::string_view pattern, std::string_view text) {
  size_t p = 0, t = 0, star = pattern.npos, resume = 0;
  while (t < text.size()) {
    if (p < pattern.size() && pattern[p] == '*') {
      star = p++;
      resume = t;
    } else if (p < pattern.size() && (pattern[p] == '?' || pattern[p] == text[t])) {
      ++p;
      ++t;
    } else if (star != pattern.npos) {
      p = star + 1;
      t = ++resume;
    } else {
      return false;
    }
  }
  return pattern.find_first_not_of('*', p) == pattern.npos;
}

std::vector<fs::path> expand_folders(const std::string& pattern) {
  std::vector<fs::path> found = {fs::path()};
  for (const fs::path& part : fs::path(pattern)) {
    const std::string name = part.string();
    if (name.empty()) continue;
    std::vector<fs::path> next;
    for (const fs::path& folder : found) {
      if (has_wildcard(name)) {
        const std::vector<fs::path> below = subfolders(folder, name);
        next.insert(next.end(), below.begin(), below.end());
      } else {
        next.push_back(folder / part);
      }
    }
    found = std::move(next);
  }
  std::error_code failure;
  std::erase_if(found, [&](const fs::path& folder) { return !fs::is_directory(folder, failure); });
  std::sort(found.begin(), found.end(),
            [](const fs::path& a, const fs::path& b) { return a.native() < b.native(); });
  return found;
}

std::vector<std::string> files_in(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code failure;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, failure)) {
    const std::string name = entry.path().filename().string();
    if (name.front() != '.' && entry.is_regular_file(failure)) names.push_back(name);
  }
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace kiln

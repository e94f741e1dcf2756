// SPDX-License-Identifier: Apache-2.0
#include "glob.h"

#include <algorithm>

namespace kiln {
namespace {

namespace fs = std::filesystem;

bool has_wildcard(std::string_view text) { return text.find_first_of("*?") != text.npos; }

std::vector<fs::path> entries(const fs::path& folder, const std::string& pattern) {
  std::vector<fs::path> found;
  std::error_code failure;
  const fs::path listed = folder.empty() ? fs::path(".") : folder;
  for (const fs::directory_entry& entry : fs::directory_iterator(listed, failure)) {
    const std::string name = entry.path().filename().string();
    const bool hidden = name.front() == '.' && pattern.front() != '.';
    if (!hidden && matches(pattern, name)) found.push_back(folder / name);
  }
  return found;
}

// Whatever there is at such a path, and what would be there where the last part is no pattern.
std::vector<fs::path> expand(const std::string& pattern) {
  std::vector<fs::path> found = {fs::path()};
  for (const fs::path& part : fs::path(pattern)) {
    const std::string name = part.string();
    if (name.empty()) continue;
    std::vector<fs::path> next;
    for (const fs::path& folder : found) {
      if (has_wildcard(name)) {
        const std::vector<fs::path> below = entries(folder, name);
        next.insert(next.end(), below.begin(), below.end());
      } else {
        next.push_back(folder / part);
      }
    }
    found = std::move(next);
  }
  std::sort(found.begin(), found.end(),
            [](const fs::path& a, const fs::path& b) { return a.native() < b.native(); });
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
  std::vector<fs::path> found = expand(pattern);
  std::error_code failure;
  std::erase_if(found, [&](const fs::path& path) { return !fs::is_directory(path, failure); });
  return found;
}

std::vector<fs::path> expand_files(const std::string& pattern) {
  std::vector<fs::path> found = expand(pattern);
  std::error_code failure;
  std::erase_if(found, [&](const fs::path& path) { return !fs::is_regular_file(path, failure); });
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

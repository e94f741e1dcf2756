// SPDX-License-Identifier: Apache-2.0
#include "attribute_lines.h"

#include <algorithm>

namespace kiln::io {

std::string comment_line(std::string_view prefix, std::string_view name, std::string_view text) {
  std::string line(prefix);
  line.append(name).append(": ").append(text);
  std::replace_if(
      line.begin(), line.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
  return line += '\n';
}

std::optional<std::pair<std::string, std::string>> attribute_of(std::string_view line) {
  const size_t colon = line.find(": ");
  if (colon == std::string_view::npos || colon == 0) return std::nullopt;
  std::string_view text = line.substr(colon + 2);
  while (!text.empty() && (text.back() == '\r' || text.back() == ' ')) text.remove_suffix(1);
  return std::pair{std::string(line.substr(0, colon)), std::string(text)};
}

}  // namespace kiln::io

// SPDX-License-Identifier: Apache-2.0
#include "tiff_description.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "attribute_lines.h"

namespace kiln::io {
namespace {

constexpr std::string_view description_tag = "ImageDescription";

// Adobe, "TIFF 6.0", section 8; Pixar's tags of textures.
bool has_tag(std::string_view name) {
  constexpr std::array<std::string_view, 10> tags{
      "Software", "Artist",       "Copyright", "DocumentName",  "Make",
      "Model",    "HostComputer", "DateTime",  "textureformat", "wrapmodes"};
  return name.starts_with("oiio:") || std::find(tags.begin(), tags.end(), name) != tags.end();
}

// The lines of a description that stay, those that are attributes going to `found`.
std::string plain_lines(std::string_view text, Attributes& found) {
  const size_t first_end = std::min(text.find('\n'), text.size());
  std::string plain(text.substr(0, first_end));
  text.remove_prefix(std::min(first_end + 1, text.size()));
  while (!text.empty()) {
    const size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    const auto attribute = attribute_of(line);
    if (attribute && attribute->first.find(' ') == std::string::npos) {
      found.push_back(*attribute);
    } else {
      plain.append("\n").append(line);
    }
  }
  return plain;
}

}  // namespace

Attributes as_tiff_tags(const Attributes& attributes) {
  Attributes tags;
  std::string description, lines;
  for (const auto& [name, text] : attributes) {
    if (name == description_tag) {
      description = text;
    } else if (has_tag(name)) {
      tags.emplace_back(name, text);
    } else {
      lines += comment_line("", name, text);
    }
  }
  if (!lines.empty()) description.append("\n").append(lines, 0, lines.size() - 1);
  if (!description.empty()) tags.emplace_back(description_tag, description);
  return tags;
}

Attributes from_tiff_tags(const Attributes& tags) {
  Attributes attributes;
  for (const auto& [name, text] : tags) {
    if (name != description_tag) {
      attributes.emplace_back(name, text);
      continue;
    }
    const std::string plain = plain_lines(text, attributes);
    if (!plain.empty()) attributes.emplace_back(name, plain);
  }
  return attributes;
}

}  // namespace kiln::io

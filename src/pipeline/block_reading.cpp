// SPDX-License-Identifier: Apache-2.0
#include "block_reading.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace kiln {

std::vector<std::string> scalars(const Node& node) {
  if (node.kind == Node::Kind::Scalar) return {node.text};
  std::vector<std::string> texts;
  for (const Node& item : node.items) texts.push_back(item.text);
  return texts;
}

std::string one_text(const Node& node) {
  const std::vector<std::string> texts = scalars(node);
  const bool numbers = std::all_of(texts.begin(), texts.end(), [](const std::string& text) {
    return text.find_first_not_of("0123456789.+-eE") == std::string::npos;
  });
  return fmt::format("{}", fmt::join(texts, numbers ? "," : ";"));
}

}  // namespace kiln

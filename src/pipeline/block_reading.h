// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "kiln/pipeline/document.h"

namespace kiln {

/// The text of a key, or `initial` where it is missing.
inline std::string text_at(const Node& block, std::string_view key,
                           const std::string& initial = {}) {
  const Node* node = block.find(key);
  return node ? node->text : initial;
}

/// Calls use(node) when the key is there.
template <class Use>
void with(const Node& block, std::string_view key, Use&& use) {
  if (const Node* node = block.find(key)) use(*node);
}

/// The scalars of a list, or the one that stands in its place.
std::vector<std::string> scalars(const Node& node);

/// Lists of numbers as one text with commas between; lists of texts take semicolons, for a text may
/// hold commas itself.
std::string one_text(const Node& node);

}  // namespace kiln

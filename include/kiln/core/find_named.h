// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "kiln/core/error.h"
#include "kiln/core/names.h"

namespace kiln {

/// The item of a list that has that `name`; case, '-' and '_' make no difference.
/// @param kind  what the items are, for the message
/// @error Fault::Usage with the nearest known name
template <class Item>
const Item& find_named(const std::vector<Item>& items, std::string_view kind,
                       std::string_view name) {
  std::vector<std::string> known;
  for (const Item& item : items) {
    if (item.name == kebab(name)) return item;
    known.emplace_back(item.name);
  }
  throw Error(Fault::Usage, unknown_name(kind, name, known));
}

}  // namespace kiln

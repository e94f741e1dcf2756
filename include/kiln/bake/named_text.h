// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace kiln {

/// Something with a name, what it is, and facts: "source", "Karis 2013".
struct NamedText {
  std::string name, summary;
  std::vector<std::pair<std::string, std::string>> facts;
};

}  // namespace kiln

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "script_tokens.h"

namespace kiln::io {

/// What stands in front of a list of numbers.
struct Declarator {
  std::string name;        ///< of the variable, member or key
  std::vector<int> shape;  ///< literal lengths: [64][64][2]
  std::string type;        ///< the words before the name and behind the '=': "static const float"
};

/// @param before  tokens of the statement up to the list, the nearest last
Declarator declarator_of(const std::vector<Token>& before);

}  // namespace kiln::io

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace kiln {

/// Words separated by commas or blanks, each out of `known` ('-' and '_' alike).
/// @error Fault::Usage with the nearest known word
std::vector<std::string> word_list(const std::string& key, const std::string& text,
                                   const std::vector<std::string>& known);

/// Numbers, likewise.
/// @error Fault::Usage
std::vector<double> number_list(const std::string& key, const std::string& text);

}  // namespace kiln

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace kiln {

/// Lower case with '-' between words: "Base_Color" -> "base-color". Values and options.
std::string kebab(std::string_view name);

/// Lower case with '_' between words: "base-color" -> "base_color". Keys in files.
std::string snake(std::string_view name);

/// The known name closest to `word` by edit distance, if any is close enough to be a slip of the
/// hand (at most a third of its letters, rounded up). Spelling with '-' or '_' is the same.
std::optional<std::string> nearest_name(std::string_view word,
                                        const std::vector<std::string>& known);

/// "unknown KIND 'WORD' (did you mean 'NEAREST'?)", or with the list of known names instead.
std::string unknown_name(std::string_view kind, std::string_view word,
                         const std::vector<std::string>& known);

}  // namespace kiln

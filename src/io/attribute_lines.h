// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace kiln::io {

/// PREFIX "name: text" and the end of the line; line breaks in the text become blanks.
std::string comment_line(std::string_view prefix, std::string_view name, std::string_view text);

/// What comment_line made, without the prefix; nothing where the line has no name and ": " in
/// front.
std::optional<std::pair<std::string, std::string>> attribute_of(std::string_view line);

}  // namespace kiln::io

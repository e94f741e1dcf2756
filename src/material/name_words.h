// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace kiln {

/// A word of a file name, in lower case.
struct NameWord {
  std::string text;
  bool separated = false;  ///< a separator stands before it, not just a change of case
};

/// "T_Rock02_BaseColor.1001" -> t, rock, 02, base, color, 1001. Words end at anything that is
/// neither letter nor digit, between letters and digits, and before a capital that begins a word.
std::vector<NameWord> split_words(std::string_view stem);

/// Lower case without separators: "nor_gl" and "NorGL" -> "norgl".
std::string squeezed(std::string_view name);

/// The name without extension, and the extension in lower case with its dot.
std::string_view name_stem(std::string_view file);
std::string name_extension(std::string_view file);

/// A word that says nothing of a map's meaning: numbers, resolutions, UDIM tiles, versions.
bool is_neutral(const std::string& word);

/// A word that marks a picture of the material instead of a map of it.
bool is_preview(const std::string& word);

}  // namespace kiln

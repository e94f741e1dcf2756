// SPDX-License-Identifier: Apache-2.0
#include "name_words.h"

#include <algorithm>
#include <array>
#include <cctype>

namespace kiln {
namespace {

enum class Kind { Separator, Digit, Lower, Upper };

Kind kind_of(char c) {
  const auto letter = static_cast<unsigned char>(c);
  if (std::isdigit(letter)) return Kind::Digit;
  if (std::isupper(letter)) return Kind::Upper;
  // Bytes of letters beyond ASCII stay inside their word.
  if (std::islower(letter) || letter >= 0x80) return Kind::Lower;
  return Kind::Separator;
}

char lower(char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); }

// Whether a word begins at `i` although no separator stands before it.
bool begins_inside(std::string_view name, size_t i) {
  const Kind before = kind_of(name[i - 1]);
  const Kind here = kind_of(name[i]);
  if ((before == Kind::Digit) != (here == Kind::Digit)) return true;
  if (before == Kind::Lower && here == Kind::Upper) return true;
  // The last capital of a run belongs to the word it begins: ORM|Texture.
  return before == Kind::Upper && here == Kind::Upper && i + 1 < name.size() &&
         kind_of(name[i + 1]) == Kind::Lower;
}

template <size_t N>
bool is_one_of(const std::array<std::string_view, N>& words, const std::string& word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

constexpr std::array<std::string_view, 29> neutral_words = {
    "k",   "x",      "px",   "u",   "v",        "udim", "uvtile",  "jpg",  "jpeg", "png",
    "exr", "tif",    "tiff", "map", "tex",      "tx",   "texture", "gltf", "srgb", "rgb",
    "s",   "linear", "lin",  "raw", "seamless", "tile", "bit",     "var",  "lod"};
constexpr std::array<std::string_view, 7> preview_words = {
    "preview", "thumb", "thumbnail", "render", "sphere", "icon", "screenshot"};

}  // namespace

std::vector<NameWord> split_words(std::string_view stem) {
  std::vector<NameWord> words;
  bool separator = false;
  for (size_t i = 0; i < stem.size(); ++i) {
    if (kind_of(stem[i]) == Kind::Separator) {
      separator = true;
      continue;
    }
    if (words.empty() || separator || begins_inside(stem, i)) {
      words.push_back({"", separator && !words.empty()});
    }
    words.back().text += lower(stem[i]);
    separator = false;
  }
  return words;
}

std::string squeezed(std::string_view name) {
  std::string result;
  for (const char c : name) {
    if (kind_of(c) != Kind::Separator) result += lower(c);
  }
  return result;
}

std::string_view name_stem(std::string_view file) {
  const size_t dot = file.rfind('.');
  return dot == std::string_view::npos || dot == 0 ? file : file.substr(0, dot);
}

std::string name_extension(std::string_view file) {
  std::string extension(file.substr(name_stem(file).size()));
  std::transform(extension.begin(), extension.end(), extension.begin(), lower);
  return extension;
}

bool is_neutral(const std::string& word) {
  const bool number =
      std::all_of(word.begin(), word.end(), [](char c) { return kind_of(c) == Kind::Digit; });
  return number || is_one_of(neutral_words, word);
}

bool is_preview(const std::string& word) { return is_one_of(preview_words, word); }

}  // namespace kiln

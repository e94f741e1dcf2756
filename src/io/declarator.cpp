// SPDX-License-Identifier: Apache-2.0
#include "declarator.h"

#include <algorithm>

namespace kiln::io {
namespace {

using Kind = Token::Kind;

void append_word(std::string_view word, std::string& text) {
  if (!text.empty()) text += ' ';
  text += word;
}

// The sign that gives a value to a name: the last '=' or ':' in front of the list; the number of
// tokens where the list follows its declaration directly.
size_t assignment(const std::vector<Token>& before) {
  for (size_t i = before.size(); i-- > 0;) {
    if (before[i].is('=') || before[i].is(':')) return i;
    if (before[i].is(',')) break;
  }
  return before.size();
}

// "[64][64][2]" that ends before `end`, which moves to its front.
std::vector<int> lengths(const std::vector<Token>& before, size_t& end) {
  std::vector<int> shape;
  bool literal = true;
  while (end > 0 && before[end - 1].is(']')) {
    size_t open = end - 1;
    while (open > 0 && !before[open].is('[')) --open;
    const bool one = open + 3 == end && before[open + 1].kind == Kind::Number &&
                     before[open + 1].value >= 1 && before[open + 1].value < 1e9;
    literal = literal && one;
    if (one) shape.insert(shape.begin(), static_cast<int>(before[open + 1].value));
    end = open;
  }
  return literal ? shape : std::vector<int>{};
}

}  // namespace

Declarator declarator_of(const std::vector<Token>& before) {
  Declarator result;
  const size_t sign = assignment(before);
  size_t end = sign;
  result.shape = lengths(before, end);
  const auto is_name = [&](size_t i) {
    return i > 0 && (before[i - 1].kind == Kind::Word || before[i - 1].kind == Kind::String);
  };
  if (!is_name(end)) return result;
  // TypeScript and Python put the type between: "name: number[] = [".
  const bool typed_behind =
      sign < before.size() && before[sign].is('=') && end >= 3 && before[end - 2].is(':');
  if (typed_behind && is_name(end - 2)) {
    append_word(before[end - 1].text, result.type);
    end -= 2;
    result.shape.clear();
  }
  result.name = std::string(before[end - 1].text);
  constexpr size_t furthest = 8;
  for (size_t i = end > furthest ? end - furthest : 0; i + 1 < end; ++i) {
    if (before[i].kind == Kind::Word) append_word(before[i].text, result.type);
  }
  for (size_t i = sign; i < before.size(); ++i) {
    if (before[i].kind == Kind::Word && before[i].text != "new") {
      append_word(before[i].text, result.type);
    }
  }
  return result;
}

}  // namespace kiln::io

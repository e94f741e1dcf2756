// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <utility>

#include "attribute_lines.h"
#include "base64.h"
#include "declarator.h"
#include "kiln/io/image_file.h"
#include "number_text.h"
#include "script_tokens.h"

namespace kiln::io {
namespace {

using Kind = Token::Kind;

constexpr int deepest = 8;

char closer_of(const Token& token) {
  if (token.is('[')) return ']';
  if (token.is('{')) return '}';
  return token.is('(') ? ')' : '\0';
}

// A list of numbers, as it is read.
struct List {
  std::vector<double> values;
  bool integers = true;
  bool wrapped = false;  // some number stands in a call: half(0x3c00)
};

// Reads lists into one row of numbers, and says of each its shape.
class ListReader {
 public:
  ListReader(Tokens& tokens, List& list) : tokens_(tokens), list_(list) {}

  /// The shape of the list whose opening sign was just taken, {n} where its parts differ; nothing
  /// where it holds more than numbers.
  std::optional<std::vector<int>> shape(char closer, int depth) {
    if (depth > deepest) return std::nullopt;
    const size_t first = list_.values.size();
    std::vector<int> part;
    size_t parts = 0, numbers = 0;
    bool even = true, after_word = false, fresh = true;
    for (Token token = tokens_.next();; token = tokens_.next()) {
      const bool was_fresh = std::exchange(fresh, token.is(','));
      if (was_fresh && (token.is('-') || token.is('+'))) token = signed_number(token.is('-'));
      const char inner = closer_of(token);
      if (after_word && inner == '\0' && token.kind != Kind::Word) return std::nullopt;
      if (token.is(',')) continue;
      if (token.is(closer)) break;
      if (take_number(token)) {
        ++numbers;
        continue;
      }
      after_word = inner == '\0';  // the name of a call
      if (after_word) {
        if (token.kind != Kind::Word) return std::nullopt;
        list_.wrapped = true;
        continue;
      }
      const auto found = shape(inner, depth + 1);
      if (!found) return std::nullopt;
      even = even && (parts == 0 || *found == part);
      part = *found;
      ++parts;
    }
    const auto count = static_cast<int>(list_.values.size() - first);
    if (parts == 0) return std::vector<int>{count};
    if (!even || numbers > 0) return std::vector<int>{count};
    part.insert(part.begin(), static_cast<int>(parts));
    return part;
  }

 private:
  // "- 0.5", with a blank.
  Token signed_number(bool negative) {
    Token token = tokens_.next();
    if (token.kind != Kind::Number) return {};
    if (negative) token.value = -token.value;
    return token;
  }

  bool take_number(const Token& token) {
    std::optional<NumberText> word;
    if (token.kind == Kind::Word) word = whole_number(token.text);
    if (token.kind != Kind::Number && !word) return false;
    list_.values.push_back(word ? word->value : token.value);
    list_.integers = list_.integers && !word && token.integer;
    return true;
  }

  Tokens& tokens_;
  List& list_;
};

size_t product(const std::vector<int>& shape) {
  return std::accumulate(shape.begin(), shape.end(), size_t{1}, [](size_t all, int one) {
    constexpr size_t most = size_t{1} << 40;
    return std::min(most, all * static_cast<size_t>(one));
  });
}

// Braces of C++ classes and calls around single numbers are no axes.
std::vector<int> without_wrapping(std::vector<int> shape, bool braces, bool wrapped) {
  const auto erase_front = [&] {
    while (shape.size() > 1 && shape.front() == 1) shape.erase(shape.begin());
  };
  if (braces) erase_front();
  if (wrapped && shape.size() > 1 && shape.back() == 1) shape.pop_back();
  return shape;
}

NumberArray array_of(List list, std::vector<int> shape, const Declarator& declarator, bool braces) {
  NumberArray array;
  array.name = declarator.name;
  const bool stated = !declarator.shape.empty() && product(declarator.shape) == list.values.size();
  array.shape =
      stated ? declarator.shape : without_wrapping(std::move(shape), braces, list.wrapped);
  array.stored = list.integers ? NumberArray::Stored::Integer : NumberArray::Stored::Decimal;
  array.values = std::move(list.values);
  if (!declarator.type.empty()) array.notes.push_back("declared as " + declarator.type);
  return array;
}

// A list may also stand in parentheses where a value is expected.
bool may_open(const Token& token, const std::vector<Token>& before) {
  if (!token.is('(')) return closer_of(token) != '\0';
  return !before.empty() && (before.back().is('=') || before.back().is(']'));
}

constexpr std::string_view png_mark = "data:image/png;base64,";
constexpr std::string_view png_in_base64 = "iVBORw0KGgo";

void take_image(const Token& token, const std::vector<Token>& before, ScriptArrays& found) {
  std::string_view text = token.text;
  if (text.starts_with(png_mark)) text.remove_prefix(png_mark.size());
  if (!text.starts_with(png_in_base64)) return;
  found.images.push_back({declarator_of(before).name, base64_bytes(text)});
}

Attributes attributes_of(std::string_view comment) {
  Attributes attributes;
  while (!comment.empty()) {
    const size_t end = std::min(comment.find('\n'), comment.size());
    std::string_view line = comment.substr(0, end);
    comment.remove_prefix(std::min(end + 1, comment.size()));
    line.remove_prefix(std::min(line.find_first_not_of(" \t*"), line.size()));
    if (const auto found = attribute_of(line)) attributes.push_back(*found);
  }
  return attributes;
}

// Tokens of the statement so far; those far back say nothing of a list.
void remember(const Token& token, std::vector<Token>& before) {
  constexpr size_t most = 64;
  if (token.is(';') || token.is('{') || token.is('}')) return before.clear();
  if (before.size() == most) before.erase(before.begin(), before.begin() + most / 2);
  before.push_back(token);
}

}  // namespace

ScriptArrays read_script_arrays(std::string_view text, size_t least) {
  ScriptArrays found;
  const Attributes attributes = attributes_of(first_block_comment(text));
  Tokens tokens(text);
  std::vector<Token> before;
  for (Token token = tokens.next(); token.kind != Kind::End; token = tokens.next()) {
    if (token.kind == Kind::String) take_image(token, before, found);
    if (may_open(token, before)) {
      const size_t inside = tokens.at();
      List list;
      const auto shape = ListReader(tokens, list).shape(closer_of(token), 1);
      if (shape && list.values.size() >= least) {
        found.arrays.push_back(
            array_of(std::move(list), *shape, declarator_of(before), token.is('{')));
        found.arrays.back().attributes = attributes;
        before.clear();
        continue;
      }
      tokens.go_to(inside);
    }
    remember(token, before);
  }
  return found;
}

}  // namespace kiln::io

// SPDX-License-Identifier: Apache-2.0
#include "script_tokens.h"

#include <algorithm>

#include "number_text.h"

namespace kiln::io {
namespace {

bool is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }
bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_word(char c) {
  return is_digit(c) || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == '$';
}

}  // namespace

void Tokens::skip_blanks_and_comments() {
  while (at_ < text_.size()) {
    const std::string_view rest = text_.substr(at_);
    if (is_blank(rest[0])) {
      ++at_;
    } else if (rest[0] == '#' || rest.starts_with("//")) {
      at_ += std::min(rest.find('\n'), rest.size());
    } else if (rest.starts_with("/*")) {
      const size_t end = rest.find("*/", 2);
      at_ = end == std::string_view::npos ? text_.size() : at_ + end + 2;
    } else {
      return;
    }
  }
}

// A string ends on its line, but for one between backquotes; else its quote is a sign.
Token Tokens::string_token(char quote) {
  const size_t first = at_ + 1;
  for (size_t at = first; at < text_.size(); ++at) {
    const char c = text_[at];
    if (c == '\n' && quote != '`') break;
    if (c == '\\') {
      ++at;
    } else if (c == quote) {
      at_ = at + 1;
      return {Token::Kind::String, text_.substr(first, at - first)};
    }
  }
  return {Token::Kind::Sign, text_.substr(at_++, 1)};
}

Token Tokens::next() {
  skip_blanks_and_comments();
  if (at_ >= text_.size()) return {};
  const std::string_view rest = text_.substr(at_);
  const char c = rest[0];
  if (c == '"' || c == '\'' || c == '`') return string_token(c);
  const bool after_word = at_ > 0 && (is_word(text_[at_ - 1]) || text_[at_ - 1] == ')');
  if (is_digit(c) || c == '.' || ((c == '-' || c == '+') && !after_word)) {
    constexpr size_t longest = 512;
    const NumberText number = number_at_front(rest.substr(0, longest));
    if (number.length > 0) {
      at_ += number.length;
      return {Token::Kind::Number, rest.substr(0, number.length), number.value, number.integer};
    }
  }
  size_t length = 0;
  while (length < rest.size() && is_word(rest[length])) ++length;
  at_ += std::max<size_t>(length, 1);
  if (length > 0) return {Token::Kind::Word, rest.substr(0, length)};
  return {Token::Kind::Sign, rest.substr(0, 1)};
}

std::string_view first_block_comment(std::string_view text) {
  const size_t first = text.find("/*");
  if (first == std::string_view::npos) return {};
  const std::string_view rest = text.substr(first + 2);
  return rest.substr(0, std::min(rest.find("*/"), rest.size()));
}

}  // namespace kiln::io

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace kiln::io {

/// A piece of a program's text, in the way that C, JavaScript, JSON and Python have in common.
struct Token {
  enum class Kind { End, Number, Word, String, Sign };
  Kind kind = Kind::End;
  std::string_view text;  ///< of a string without its quotes
  double value = 0;       ///< of a number
  bool integer = false;

  bool is(char sign) const { return kind == Kind::Sign && text[0] == sign; }
};

/// Cuts a text into tokens. Comments of these languages and lines of a preprocessor are passed
/// over; what fits nothing is a sign of one byte.
class Tokens {
 public:
  explicit Tokens(std::string_view text) : text_(text) {}

  Token next();
  size_t at() const { return at_; }
  void go_to(size_t at) { at_ = at; }

 private:
  void skip_blanks_and_comments();
  Token string_token(char quote);

  std::string_view text_;
  size_t at_ = 0;
};

/// The text of the first block comment, without its marks.
std::string_view first_block_comment(std::string_view text);

}  // namespace kiln::io

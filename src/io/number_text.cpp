// SPDX-License-Identifier: Apache-2.0
#include "number_text.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <string>

namespace kiln::io {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_word(char c) {
  return is_digit(c) || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == '$';
}

struct Digits {
  double value = 0;
  size_t length = 0;
};

// What from_chars takes; beyond a double's range 0 or infinity, as the exponent's sign says.
Digits digits(std::string_view text, std::chars_format format) {
  Digits result;
  const auto parsed = std::from_chars(text.data(), text.data() + text.size(), result.value, format);
  if (parsed.ec == std::errc::invalid_argument) return {};
  result.length = static_cast<size_t>(parsed.ptr - text.data());
  if (parsed.ec == std::errc::result_out_of_range) {
    const std::string_view taken = text.substr(0, result.length);
    const bool tiny = taken.find("e-") != std::string_view::npos ||
                      taken.find("E-") != std::string_view::npos ||
                      taken.find("p-") != std::string_view::npos || taken.starts_with("0.") ||
                      taken.starts_with('.');
    result.value = tiny ? 0.0 : std::numeric_limits<double>::infinity();
  }
  return result;
}

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return result;
}

}  // namespace

NumberText number_at_front(std::string_view text) {
  NumberText number;
  size_t at = !text.empty() && (text[0] == '-' || text[0] == '+') ? 1 : 0;
  const bool negative = at == 1 && text[0] == '-';
  const auto char_at = [&](size_t i) { return i < text.size() ? text[i] : '\0'; };
  const bool hex = char_at(at) == '0' && (char_at(at + 1) == 'x' || char_at(at + 1) == 'X');
  if (hex) at += 2;
  const bool begins =
      hex ? is_word(char_at(at)) || char_at(at) == '.'
          : is_digit(char_at(at)) || (char_at(at) == '.' && is_digit(char_at(at + 1)));
  if (!begins) return {};
  const Digits found =
      digits(text.substr(at), hex ? std::chars_format::hex : std::chars_format::general);
  if (found.length == 0) return {};
  const std::string_view taken = text.substr(at, found.length);
  number.integer = taken.find_first_of(hex ? ".pP" : ".eE") == std::string_view::npos;
  at += found.length;
  while (char_at(at) != '\0' &&
         std::string_view("fFlLuUnh").find(char_at(at)) != std::string_view::npos) {
    if (char_at(at) == 'f' || char_at(at) == 'F' || char_at(at) == 'h') number.integer = false;
    ++at;
  }
  if (is_word(char_at(at)) || char_at(at) == '.') return {};
  number.value = negative ? -found.value : found.value;
  number.length = at;
  return number;
}

std::optional<NumberText> whole_number(std::string_view text) {
  const NumberText number = number_at_front(text);
  if (number.length == text.size() && number.length > 0) return number;
  if (text.size() < 3 || text.size() > 9) return std::nullopt;
  std::string word = lower(text);
  const bool negative = word[0] == '-';
  if (negative || word[0] == '+') word.erase(0, 1);
  double value = 0;
  if (word == "nan") {
    value = std::numeric_limits<double>::quiet_NaN();
  } else if (word == "inf" || word == "infinity") {
    value = std::numeric_limits<double>::infinity();
  } else {
    return std::nullopt;
  }
  return NumberText{negative ? -value : value, false, text.size()};
}

}  // namespace kiln::io

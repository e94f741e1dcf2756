// SPDX-License-Identifier: Apache-2.0
#include "kiln/core/param.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace kiln {
namespace {

[[noreturn]] void refuse(const ParamFacts& facts, const std::string& text,
                         const std::string& expected) {
  throw Error(Fault::Usage, fmt::format("{}: found '{}', expected {}", facts.name, text, expected));
}

std::string range_text(const ParamFacts& facts, std::string_view kind) {
  if (std::isinf(facts.min) && std::isinf(facts.max)) return std::string(kind);
  if (std::isinf(facts.max)) return fmt::format("{} >= {}", kind, facts.min);
  return fmt::format("{} from {} to {}", kind, facts.min, facts.max);
}

template <class T>
T parse_whole(const ParamFacts& facts, std::string_view text, std::string_view kind) {
  T value{};
  const char* end = text.data() + text.size();
  const auto result = std::from_chars(text.data(), end, value);
  const bool whole = result.ec == std::errc() && result.ptr == end;
  const bool in_range =
      static_cast<double>(value) >= facts.min && static_cast<double>(value) <= facts.max;
  if (!whole || !in_range) refuse(facts, std::string(text), range_text(facts, kind));
  return value;
}

}  // namespace

std::string number_text(double value) { return fmt::format("{}", value); }

double parse_number(const ParamFacts& facts, const std::string& text) {
  return parse_whole<double>(facts, text, "a number");
}

long long parse_integer(const ParamFacts& facts, const std::string& text) {
  return parse_whole<long long>(facts, text, "a whole number");
}

long long parse_bytes(const std::string& name, const std::string& text) {
  constexpr std::string_view letters = "KMGT";
  ParamFacts facts;
  facts.name = name;
  const char* end = text.data() + text.size();
  double number = 0;
  const auto read = std::from_chars(text.data(), end, number);
  std::string unit(read.ptr, end);
  std::erase(unit, ' ');
  long long factor = 1;
  const size_t power = unit.empty() ? std::string_view::npos : letters.find(unit[0]);
  const bool known = unit.empty() || unit == "B" ||
                     (power != std::string_view::npos &&
                      (unit.size() == 1 || unit.substr(1) == "iB" || unit.substr(1) == "B"));
  if (power != std::string_view::npos) factor = 1LL << (10 * (power + 1));
  if (read.ec != std::errc() || !known || !(number > 0) ||
      number * static_cast<double>(factor) > 1e18) {
    refuse(facts, text, "a size, for instance 2GiB or 512MiB");
  }
  return static_cast<long long>(number * static_cast<double>(factor));
}

bool parse_flag(const ParamFacts& facts, const std::string& text) {
  const std::string word = kebab(text);
  if (word == "true" || word == "yes" || word == "on" || word == "1") return true;
  if (word == "false" || word == "no" || word == "off" || word == "0") return false;
  refuse(facts, text, "true or false");
}

size_t parse_word(const ParamFacts& facts, const std::string& text) {
  const auto found = std::find(facts.choices.begin(), facts.choices.end(), kebab(text));
  if (found != facts.choices.end()) return static_cast<size_t>(found - facts.choices.begin());
  throw Error(Fault::Usage, unknown_name(facts.name, text, facts.choices));
}

Size parse_extent(const ParamFacts& facts, const std::string& text) {
  const size_t cross = text.find_first_of("xX");
  const std::string_view all(text);
  const int width = parse_whole<int>(facts, all.substr(0, cross), "a size N or WxH, each");
  if (cross == std::string::npos) return {width, width};
  return {width, parse_whole<int>(facts, all.substr(cross + 1), "a size N or WxH, each")};
}

}  // namespace kiln

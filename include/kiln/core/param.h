// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "kiln/core/error.h"
#include "kiln/core/names.h"
#include "kiln/core/size.h"

namespace kiln {

/// What a parameter is, told once: command line, pipeline files, help, docs and schema follow.
struct ParamFacts {
  enum class Kind { Flag, Integer, Number, Word, Extent, Text };
  std::string name;  ///< snake_case
  Kind kind = Kind::Text;
  std::string default_text;
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
  std::vector<std::string> choices;  ///< of a Word
  std::string unit;                  ///< "[EV]", "[degree]" or empty
  std::string meaning;               ///< one line
};

/// A parameter of the settings struct S: its facts and how to set it from text.
template <class S>
struct Param {
  ParamFacts facts;
  std::function<void(S&, const std::string&)> assign;
};

template <class S>
using Params = std::vector<Param<S>>;

struct Range {
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
};

/// Text to value, with the range checked; throws Fault::Usage that names the parameter.
double parse_number(const ParamFacts& facts, const std::string& text);
long long parse_integer(const ParamFacts& facts, const std::string& text);
bool parse_flag(const ParamFacts& facts, const std::string& text);
size_t parse_word(const ParamFacts& facts, const std::string& text);  ///< index into choices
/// "2GiB", "512 MiB", "1.5G", "4000000": [byte].
long long parse_bytes(const std::string& name, const std::string& text);
Size parse_extent(const ParamFacts& facts, const std::string& text);  ///< "512" or "512x256"
std::string number_text(double value);

template <class S>
Param<S> number_param(std::string name, double S::*member, Range range, std::string unit,
                      std::string meaning) {
  ParamFacts facts{
      std::move(name), ParamFacts::Kind::Number, number_text(S{}.*member), range.min, range.max, {},
      std::move(unit), std::move(meaning)};
  return {facts, [facts, member](S& settings, const std::string& text) {
            settings.*member = parse_number(facts, text);
          }};
}

template <class S>
Param<S> integer_param(std::string name, int S::*member, Range range, std::string meaning) {
  ParamFacts facts{std::move(name),
                   ParamFacts::Kind::Integer,
                   std::to_string(S{}.*member),
                   range.min,
                   range.max,
                   {},
                   "",
                   std::move(meaning)};
  return {facts, [facts, member](S& settings, const std::string& text) {
            settings.*member = static_cast<int>(parse_integer(facts, text));
          }};
}

template <class S>
Param<S> flag_param(std::string name, bool S::*member, std::string meaning) {
  ParamFacts facts{
      std::move(name),   ParamFacts::Kind::Flag, S{}.*member ? "true" : "false", 0, 1, {}, "",
      std::move(meaning)};
  return {facts, [facts, member](S& settings, const std::string& text) {
            settings.*member = parse_flag(facts, text);
          }};
}

template <class S>
Param<S> text_param(std::string name, std::string S::*member, std::string meaning) {
  ParamFacts facts{std::move(name),   ParamFacts::Kind::Text, S{}.*member, 0, 0, {}, "",
                   std::move(meaning)};
  return {facts, [member](S& settings, const std::string& text) { settings.*member = text; }};
}

template <class S>
Param<S> extent_param(std::string name, Size S::*member, Range range, std::string meaning) {
  const Size size = S{}.*member;
  std::string shown = size == Size{}
                          ? std::string("input")
                          : std::to_string(size.width) + "x" + std::to_string(size.height);
  ParamFacts facts{
      std::move(name), ParamFacts::Kind::Extent, std::move(shown), range.min, range.max, {},
      "[texel]",       std::move(meaning)};
  return {facts, [facts, member](S& settings, const std::string& text) {
            settings.*member = parse_extent(facts, text);
          }};
}

/// A word out of a closed list; enumerators are numbered as `choices` is.
template <class S, class Enum>
Param<S> word_param(std::string name, Enum S::*member, std::vector<std::string> choices,
                    std::string meaning) {
  std::string initial = choices.at(static_cast<size_t>(S{}.*member));
  ParamFacts facts{
      std::move(name),   ParamFacts::Kind::Word, std::move(initial), 0, 0, std::move(choices), "",
      std::move(meaning)};
  return {facts, [facts, member](S& settings, const std::string& text) {
            settings.*member = static_cast<Enum>(parse_word(facts, text));
          }};
}

/// A word out of a list of names, kept as text: "" until it is given.
template <class S>
Param<S> choice_param(std::string name, std::string S::*member, std::vector<std::string> choices,
                      std::string meaning) {
  ParamFacts facts{
      std::move(name),   ParamFacts::Kind::Word, S{}.*member, 0, 0, std::move(choices), "",
      std::move(meaning)};
  return {facts, [facts, member](S& settings, const std::string& text) {
            settings.*member = facts.choices[parse_word(facts, text)];
          }};
}

template <class S>
std::vector<ParamFacts> facts_of(const Params<S>& params) {
  std::vector<ParamFacts> facts;
  for (const Param<S>& param : params) facts.push_back(param.facts);
  return facts;
}

/// Sets one parameter by name ('-' and '_' alike); throws Fault::Usage with the nearest known name.
template <class S>
void assign(const Params<S>& params, S& settings, std::string_view name, const std::string& text) {
  std::vector<std::string> known;
  for (const Param<S>& param : params) {
    if (param.facts.name == snake(name)) return param.assign(settings, text);
    known.push_back(param.facts.name);
  }
  throw Error(Fault::Usage, unknown_name("parameter", name, known));
}

}  // namespace kiln

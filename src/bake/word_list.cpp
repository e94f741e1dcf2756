// SPDX-License-Identifier: Apache-2.0
#include "word_list.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "kiln/core/error.h"
#include "kiln/core/names.h"

namespace kiln {
namespace {

std::vector<std::string> split(const std::string& text) {
  std::vector<std::string> words;
  std::string word;
  for (const char letter : text + ",") {
    if (letter != ',' && letter != ' ') {
      word += letter;
    } else if (!word.empty()) {
      words.push_back(std::move(word));
      word.clear();
    }
  }
  return words;
}

}  // namespace

std::vector<std::string> word_list(const std::string& key, const std::string& text,
                                   const std::vector<std::string>& known) {
  std::vector<std::string> words = split(text);
  for (std::string& word : words) {
    const auto found = std::find_if(known.begin(), known.end(), [&](const std::string& one) {
      return kebab(one) == kebab(word);
    });
    if (found == known.end()) throw Error(Fault::Usage, unknown_name(key, word, known));
    word = *found;
  }
  if (words.empty()) throw Error(Fault::Usage, fmt::format("{}: found nothing", key));
  return words;
}

std::vector<double> number_list(const std::string& key, const std::string& text) {
  std::vector<double> numbers;
  for (const std::string& word : split(text)) {
    double number = 0;
    const auto read = std::from_chars(word.data(), word.data() + word.size(), number);
    if (read.ec != std::errc() || read.ptr != word.data() + word.size()) {
      throw Error(Fault::Usage, fmt::format("{}: found '{}', expected numbers", key, word));
    }
    numbers.push_back(number);
  }
  if (numbers.empty()) throw Error(Fault::Usage, fmt::format("{}: found nothing", key));
  return numbers;
}

}  // namespace kiln

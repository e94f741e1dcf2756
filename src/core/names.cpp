// SPDX-License-Identifier: Apache-2.0
#include "kiln/core/names.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <numeric>

namespace kiln {
namespace {

std::string respell(std::string_view name, char from, char to) {
  std::string result(name);
  for (char& c : result) {
    c = c == from ? to : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return result;
}

// Levenshtein distance with one row of memory.
size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), size_t{0});
  for (size_t i = 0; i < a.size(); ++i) {
    size_t diagonal = row[0];
    row[0] = i + 1;
    for (size_t j = 0; j < b.size(); ++j) {
      const size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, diagonal + 1});
    }
  }
  return row.back();
}

}  // namespace

std::string kebab(std::string_view name) { return respell(name, '_', '-'); }
std::string snake(std::string_view name) { return respell(name, '-', '_'); }

std::optional<std::string> nearest_name(std::string_view word,
                                        const std::vector<std::string>& known) {
  std::optional<std::string> best;
  size_t best_distance = (word.size() + 2) / 3 + 1;
  for (const std::string& name : known) {
    const size_t distance = edit_distance(kebab(word), kebab(name));
    if (distance < best_distance) {
      best = name;
      best_distance = distance;
    }
  }
  return best;
}

std::string unknown_name(std::string_view kind, std::string_view word,
                         const std::vector<std::string>& known) {
  if (const auto nearest = nearest_name(word, known)) {
    return fmt::format("unknown {} '{}' (did you mean '{}'?)", kind, word, *nearest);
  }
  return fmt::format("unknown {} '{}' (known: {})", kind, word, fmt::join(known, ", "));
}

}  // namespace kiln

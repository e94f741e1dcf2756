// SPDX-License-Identifier: Apache-2.0
#include "naming_match.h"

#include <algorithm>

#include "name_words.h"

namespace kiln {
namespace {

constexpr size_t short_token = 4;  // letters

bool only_at_end(const std::string& token) {
  return token.size() <= short_token || token == "metal" || token == "rough";
}

std::optional<TokenMatch> token_spelled(const std::string& spelled,
                                        const std::vector<const NamingScheme*>& schemes) {
  for (size_t s = 0; s < schemes.size(); ++s) {
    const auto& tokens = schemes[s]->tokens;
    for (size_t t = 0; t < tokens.size(); ++t) {
      if (squeezed(tokens[t].token) == spelled) return TokenMatch{s, t};
    }
  }
  return std::nullopt;
}

// The longest token that ends at words[last].
std::optional<TokenMatch> match_ending_at(const std::vector<NameWord>& words, size_t last,
                                          bool at_end,
                                          const std::vector<const NamingScheme*>& schemes) {
  std::optional<TokenMatch> longest;
  std::string spelled;
  for (size_t first = last + 1; first-- > 0;) {
    spelled.insert(0, words[first].text);
    if (only_at_end(spelled) && !at_end) continue;
    if (spelled.size() == 1 && !words[first].separated) continue;
    if (const auto match = token_spelled(spelled, schemes)) longest = match;
  }
  return longest;
}

}  // namespace

std::optional<TokenMatch> match_token(std::string_view stem,
                                      const std::vector<const NamingScheme*>& schemes) {
  const std::vector<NameWord> words = split_words(stem);
  bool at_end = true;
  for (size_t last = words.size(); last-- > 0;) {
    if (const auto match = match_ending_at(words, last, at_end, schemes)) return match;
    at_end = at_end && is_neutral(words[last].text);
  }
  return std::nullopt;
}

}  // namespace kiln

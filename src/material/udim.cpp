// SPDX-License-Identifier: Apache-2.0
#include "kiln/material/udim.h"

#include <algorithm>
#include <array>
#include <set>

#include "name_words.h"

namespace kiln {
namespace {

// What stands in a pattern: a text as it is, a tile number, or u or v counted from `first`.
struct Piece {
  enum class Kind { Text, Tile, U, V };
  Kind kind = Kind::Text;
  std::string text;
  int first = 0;
};
using Pieces = std::vector<Piece>;

struct TileToken {
  std::string_view spelling;
  Pieces pieces;
};

const std::vector<TileToken>& tile_tokens() {
  using Kind = Piece::Kind;
  const auto u_and_v = [](int first) {
    return Pieces{
        {Kind::Text, "u"}, {Kind::U, "", first}, {Kind::Text, "_v"}, {Kind::V, "", first}};
  };
  static const std::vector<TileToken> tokens = {
      {"<UDIM>", {{Kind::Tile}}},  {"<udim>", {{Kind::Tile}}},  {"%(UDIM)d", {{Kind::Tile}}},
      {"$udim", {{Kind::Tile}}},   {"<UVTILE>", u_and_v(1)},    {"<uvtile>", u_and_v(0)},
      {"<U>", {{Kind::U, "", 1}}}, {"<V>", {{Kind::V, "", 1}}}, {"<u>", {{Kind::U, "", 0}}},
      {"<v>", {{Kind::V, "", 0}}}};
  return tokens;
}

const TileToken* token_at(std::string_view text) {
  for (const TileToken& token : tile_tokens()) {
    if (text.starts_with(token.spelling)) return &token;
  }
  return nullptr;
}

Pieces pieces_of(std::string_view pattern) {
  Pieces pieces;
  for (size_t i = 0; i < pattern.size();) {
    if (const TileToken* token = token_at(pattern.substr(i))) {
      pieces.insert(pieces.end(), token->pieces.begin(), token->pieces.end());
      i += token->spelling.size();
      continue;
    }
    const bool fresh = pieces.empty() || pieces.back().kind != Piece::Kind::Text;
    if (fresh) pieces.push_back({});
    pieces.back().text += pattern[i++];
  }
  return pieces;
}

// Takes a number of that many digits, or of one to three, off the front.
std::optional<int> take_number(std::string_view& text, size_t digits) {
  const size_t run = std::min(text.find_first_not_of("0123456789"), text.size());
  const size_t count = digits > 0 ? digits : std::min<size_t>(run, 3);
  if (count == 0 || count > run) return std::nullopt;
  const int number = std::stoi(std::string(text.substr(0, count)));
  text.remove_prefix(count);
  return number;
}

struct TilePlace {
  std::optional<int> u, v;

  // False where the place is known already and differs.
  static bool settle(std::optional<int>& known, int value) {
    if (value < 0 || (known && *known != value)) return false;
    known = value;
    return true;
  }
};

bool take_piece(const Piece& piece, std::string_view& name, TilePlace& place) {
  if (piece.kind == Piece::Kind::Text) {
    if (!name.starts_with(piece.text)) return false;
    name.remove_prefix(piece.text.size());
    return true;
  }
  const bool whole = piece.kind == Piece::Kind::Tile;
  const auto number = take_number(name, whole ? 4 : 0);
  if (!number) return false;
  if (whole) {
    return *number > 1000 && TilePlace::settle(place.u, (*number - 1001) % 10) &&
           TilePlace::settle(place.v, (*number - 1001) / 10);
  }
  return TilePlace::settle(piece.kind == Piece::Kind::U ? place.u : place.v, *number - piece.first);
}

bool is_digits(const std::string& text) {
  return text.find_first_not_of("0123456789") == std::string::npos;
}

// Where `u1_v1` begins at the end of a stem, or npos; and whether it counts from 0.
struct UvEnding {
  size_t begin = std::string_view::npos;
  bool from_zero = false;
};

UvEnding uv_ending(std::string_view stem) {
  const size_t v = stem.rfind("_v");
  const size_t u = v == stem.npos ? v : stem.rfind('u', v);
  if (u == stem.npos || u == 0 || (stem[u - 1] != '_' && stem[u - 1] != '.')) return {};
  const std::string first(stem.substr(u + 1, v - u - 1)), second(stem.substr(v + 2));
  const bool numbers = !first.empty() && !second.empty() && first.size() < 4 && second.size() < 4 &&
                       is_digits(first) && is_digits(second);
  if (!numbers) return {};
  return {u, std::stoi(first) == 0 || std::stoi(second) == 0};
}

std::string with_ending(std::string_view file, size_t begin, std::string_view token) {
  std::string pattern(file.substr(0, begin));
  pattern += token;
  pattern += file.substr(name_stem(file).size());
  return pattern;
}

bool are_tiles(const std::set<int>& numbers) { return numbers.size() > 1 || numbers.count(1001); }

}  // namespace

bool has_tile(std::string_view pattern) {
  const Pieces pieces = pieces_of(pattern);
  return std::any_of(pieces.begin(), pieces.end(),
                     [](const Piece& piece) { return piece.kind != Piece::Kind::Text; });
}

std::optional<int> tile_of(std::string_view pattern, std::string_view name) {
  TilePlace place;
  for (const Piece& piece : pieces_of(pattern)) {
    if (!take_piece(piece, name, place)) return std::nullopt;
  }
  if (!name.empty() || !place.u || !place.v || *place.u > 9) return std::nullopt;
  return 1001 + *place.u + 10 * *place.v;
}

std::string tile_name(std::string_view pattern, int tile) {
  const int u = (tile - 1001) % 10, v = (tile - 1001) / 10;
  std::string name;
  for (const Piece& piece : pieces_of(pattern)) {
    switch (piece.kind) {
      case Piece::Kind::Text:
        name += piece.text;
        break;
      case Piece::Kind::Tile:
        name += std::to_string(tile);
        break;
      case Piece::Kind::U:
        name += std::to_string(u + piece.first);
        break;
      case Piece::Kind::V:
        name += std::to_string(v + piece.first);
        break;
    }
  }
  return name;
}

std::optional<int> udim_tile(std::string_view file) {
  const std::vector<NameWord> words = split_words(name_stem(file));
  if (words.empty() || words.back().text.size() != 4) return std::nullopt;
  if (!is_digits(words.back().text)) return std::nullopt;
  const int number = std::stoi(words.back().text);
  // 1001 + u + 10 v with u, v in 0..9; 1024 and the like are resolutions as often as tiles.
  return number >= 1001 && number <= 1100 && number != 1024 ? std::optional(number) : std::nullopt;
}

std::vector<std::string> with_tile_patterns(const std::vector<std::string>& files) {
  std::set<int> numbers;
  bool from_zero = false;
  for (const std::string& file : files) {
    if (const auto tile = udim_tile(file)) numbers.insert(*tile);
    from_zero = from_zero || uv_ending(name_stem(file)).from_zero;
  }
  std::set<std::string> names;
  for (const std::string& file : files) {
    const std::string_view stem = name_stem(file);
    const size_t uv = uv_ending(stem).begin;
    const auto tile = udim_tile(file);
    if (uv != stem.npos) {
      names.insert(with_ending(file, uv, from_zero ? "<uvtile>" : "<UVTILE>"));
    } else if (tile && are_tiles(numbers)) {
      names.insert(with_ending(file, stem.rfind(std::to_string(*tile)), "<UDIM>"));
    } else {
      names.insert(file);
    }
  }
  return {names.begin(), names.end()};
}

}  // namespace kiln

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "kiln/core/error.h"

namespace kiln {

/// A place in a text file, counted from 1. Line 0: no place, for what the command line said.
struct Place {
  std::string file;
  int line = 0;
  int column = 0;
};

/// "rocks.yaml:12:7: ", or nothing where there is no place.
std::string shown(const Place& place);

struct Entry;

/// A YAML or JSON value as it was written: scalars stay text, and nothing is guessed from them.
struct Node {
  enum class Kind { Nothing, Scalar, List, Block };
  Kind kind = Kind::Nothing;
  Place place;
  std::string text;            ///< of a scalar
  std::vector<Node> items;     ///< of a list
  std::vector<Entry> entries;  ///< of a block, in the file's order, duplicates included

  /// The value of the first entry with that key ('-' and '_' alike), or nullptr.
  const Node* find(std::string_view key) const;
};

struct Entry {
  std::string key;
  Place place;
  Node value;
};

/// What was found of a kind of value: "nothing", "a text", "a list", "a block".
std::string kind_name(Node::Kind kind);

/// Parses one YAML document; JSON is YAML.
/// @param file  the name that messages give
/// @error Fault::Usage, "FILE:LINE:COLUMN: what is wrong"
Node parse_document(const std::string& text, const std::string& file);

/// @error Fault::Input when the file is missing or unreadable, else as parse_document
Node read_document(const std::filesystem::path& file);

/// Mistakes found in one pass, reported together.
class Mistakes {
 public:
  void add(const Place& place, const std::string& message);
  bool empty() const { return list_.empty(); }
  /// @error Fault::Usage with one line a mistake, in the file's order, if there is any
  void raise() const;

 private:
  struct Mistake {
    Place place;
    std::string message;
  };
  std::vector<Mistake> list_;
};

/// The Error that leaves work(), if one does.
template <class Work>
std::optional<Error> error_leaving(Work&& work) {
  try {
    work();
  } catch (const Error& error) {
    return error;
  }
  return std::nullopt;
}

/// Runs work(); an Error that says the user is wrong becomes a mistake at that place.
template <class Work>
void attempt(Mistakes& mistakes, const Place& place, Work&& work) {
  try {
    work();
  } catch (const Error& error) {
    if (error.fault() != Fault::Usage) throw;
    mistakes.add(place, error.what());
  }
}

}  // namespace kiln

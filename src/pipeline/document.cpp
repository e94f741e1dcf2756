// SPDX-License-Identifier: Apache-2.0
#include "kiln/pipeline/document.h"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <fstream>
#include <iterator>

#include "kiln/core/names.h"

namespace kiln {
namespace {

// Aliases are copied, so a small file could ask for an endless tree.
constexpr int max_depth = 64;
constexpr long long max_nodes = 1'000'000;

class Reader {
 public:
  explicit Reader(std::string file) : file_(std::move(file)) {}

  Node read(const YAML::Node& yaml, const Place& fallback, int depth) {
    const Place here = place(yaml.Mark(), fallback);
    if (depth > max_depth || ++nodes_ > max_nodes) refuse(here, "nested too deeply, or endless");
    Node node;
    node.place = here;
    if (yaml.IsScalar()) {
      node.kind = Node::Kind::Scalar;
      node.text = yaml.Scalar();
    } else if (yaml.IsSequence()) {
      node.kind = Node::Kind::List;
      for (const YAML::Node& item : yaml) node.items.push_back(read(item, here, depth + 1));
    } else if (yaml.IsMap()) {
      node.kind = Node::Kind::Block;
      for (const auto& pair : yaml) node.entries.push_back(entry(pair.first, pair.second, depth));
    } else {
      node.place = fallback;
    }
    return node;
  }

  [[noreturn]] void refuse(const Place& where, const std::string& what) const {
    throw Error(Fault::Usage, shown(where) + what);
  }

  Place place(const YAML::Mark& mark, const Place& fallback) const {
    if (mark.is_null()) return fallback;
    return {file_, mark.line + 1, mark.column + 1};
  }

 private:
  Entry entry(const YAML::Node& key, const YAML::Node& value, int depth) {
    const Place where = place(key.Mark(), {file_, 1, 1});
    if (!key.IsScalar()) refuse(where, "a key must be a word");
    return {key.Scalar(), where, read(value, where, depth + 1)};
  }

  std::string file_;
  long long nodes_ = 0;
};

std::string text_of(const std::filesystem::path& file) {
  std::error_code failure;
  if (!std::filesystem::exists(file, failure)) {
    throw Error(Fault::Input, fmt::format("{}: no such file", file.string()));
  }
  std::ifstream stream(file, std::ios::binary);
  std::string text;
  if (stream && !std::filesystem::is_directory(file, failure)) {
    text.assign(std::istreambuf_iterator<char>(stream), {});
  } else {
    throw Error(Fault::Input, fmt::format("{}: cannot be read as a text file", file.string()));
  }
  return text;
}

}  // namespace

std::string shown(const Place& place) {
  if (place.line == 0) return "";
  return fmt::format("{}:{}:{}: ", place.file, place.line, place.column);
}

const Node* Node::find(std::string_view key) const {
  for (const Entry& entry : entries) {
    if (snake(entry.key) == snake(key)) return &entry.value;
  }
  return nullptr;
}

std::string kind_name(Node::Kind kind) {
  switch (kind) {
    case Node::Kind::Nothing:
      return "nothing";
    case Node::Kind::Scalar:
      return "a text";
    case Node::Kind::List:
      return "a list";
    case Node::Kind::Block:
      return "a block";
  }
  return "nothing";
}

Node parse_document(const std::string& text, const std::string& file) {
  Reader reader(file);
  const Place start{file, 1, 1};
  try {
    const std::vector<YAML::Node> documents = YAML::LoadAll(text);
    if (documents.size() > 1) {
      const Place second = reader.place(documents[1].Mark(), start);
      reader.refuse(second, "a second document begins; expected one");
    }
    return documents.empty() ? Node{Node::Kind::Nothing, start, {}, {}, {}}
                             : reader.read(documents[0], start, 0);
  } catch (const YAML::Exception& problem) {
    reader.refuse(reader.place(problem.mark, start), problem.msg);
  }
}

Node read_document(const std::filesystem::path& file) {
  return parse_document(text_of(file), file.string());
}

void Mistakes::add(const Place& place, const std::string& message) {
  list_.push_back({place, message});
}

void Mistakes::raise() const {
  if (list_.empty()) return;
  std::vector<Mistake> sorted = list_;
  std::stable_sort(sorted.begin(), sorted.end(), [](const Mistake& a, const Mistake& b) {
    return std::pair(a.place.line, a.place.column) < std::pair(b.place.line, b.place.column);
  });
  std::string lines;
  for (const Mistake& mistake : sorted) {
    if (!lines.empty()) lines += '\n';
    lines += shown(mistake.place) + mistake.message;
  }
  throw Error(Fault::Usage, lines);
}

}  // namespace kiln

// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "kiln/pipeline/schema.h"

namespace kiln {
namespace {

using Kind = ParamFacts::Kind;
using Shape = Key::Shape;

void check_text(const ParamFacts& facts, const std::string& text) {
  switch (facts.kind) {
    case Kind::Flag:
      parse_flag(facts, text);
      break;
    case Kind::Integer:
      parse_integer(facts, text);
      break;
    case Kind::Number:
      parse_number(facts, text);
      break;
    case Kind::Word:
      parse_word(facts, text);
      break;
    case Kind::Extent:
      parse_extent(facts, text);
      break;
    case Kind::Text:
      break;
  }
}

void check_scalar(const Node& node, const Key& key, Mistakes& mistakes) {
  const ParamFacts& facts = key.facts;
  if (node.kind != Node::Kind::Scalar) {
    mistakes.add(node.place,
                 fmt::format("{}: found {}, expected a value", facts.name, kind_name(node.kind)));
    return;
  }
  attempt(mistakes, node.place, [&] { check_text(facts, node.text); });
}

void check_against(const Node& node, const BlockFacts& block, Mistakes& mistakes);

void check_block(const Node& node, const std::string& name, Mistakes& mistakes) {
  const BlockFacts& block = block_named(name);
  if (name != "bake") return check_against(node, block, mistakes);
  const Node* chosen = node.find("bake");
  if (!chosen || chosen->kind != Node::Kind::Scalar) return check_against(node, block, mistakes);
  for (const BakeFacts& bake : all_bakes()) {
    if (bake.name == kebab(chosen->text)) return check_against(node, bake_block(bake), mistakes);
  }
  std::vector<std::string> known;
  for (const BakeFacts& bake : all_bakes()) known.push_back(bake.name);
  mistakes.add(chosen->place, unknown_name("bake", chosen->text, known));
}

void check_list(const Node& node, const Key& key, Mistakes& mistakes) {
  if (key.shape == Shape::Scalars && node.kind == Node::Kind::Scalar) {
    return check_scalar(node, key, mistakes);
  }
  if (node.kind != Node::Kind::List) {
    mistakes.add(node.place, fmt::format("{}: found {}, expected a list", key.facts.name,
                                         kind_name(node.kind)));
    return;
  }
  for (const Node& item : node.items) {
    if (key.shape == Shape::Scalars) {
      check_scalar(item, key, mistakes);
    } else {
      check_block(item, key.block, mistakes);
    }
  }
}

void find_duplicates(const Node& node, Mistakes& mistakes) {
  std::map<std::string, Place> seen;
  for (const Entry& entry : node.entries) {
    const auto [first, fresh] = seen.emplace(snake(entry.key), entry.place);
    if (fresh) continue;
    mistakes.add(entry.place, fmt::format("duplicate key '{}' (first at line {})", entry.key,
                                          first->second.line));
  }
}

void check_named(const Node& node, const Key& key, Mistakes& mistakes) {
  if (node.kind != Node::Kind::Block) {
    mistakes.add(node.place, fmt::format("{}: found {}, expected names with values", key.facts.name,
                                         kind_name(node.kind)));
    return;
  }
  find_duplicates(node, mistakes);
  for (const Entry& entry : node.entries) {
    if (key.block.empty()) {
      Key value = key;
      value.facts.name = entry.key;
      check_scalar(entry.value, value, mistakes);
    } else {
      check_block(entry.value, key.block, mistakes);
    }
  }
}

void check_value(const Node& node, const Key& key, Mistakes& mistakes) {
  switch (key.shape) {
    case Shape::Scalar:
      return check_scalar(node, key, mistakes);
    case Shape::Scalars:
    case Shape::Blocks:
      return check_list(node, key, mistakes);
    case Shape::Block:
      return check_block(node, key.block, mistakes);
    case Shape::Named:
      return check_named(node, key, mistakes);
  }
}

void check_against(const Node& node, const BlockFacts& block, Mistakes& mistakes) {
  if (node.kind == Node::Kind::Scalar && !block.shorthand.empty()) return;
  if (node.kind != Node::Kind::Block) {
    mistakes.add(node.place, fmt::format("found {}, expected {}: {}", kind_name(node.kind),
                                         block.shorthand.empty() ? "a block" : "a path or a block",
                                         block.meaning));
    return;
  }
  find_duplicates(node, mistakes);
  std::vector<std::string> known;
  for (const Key& key : block.keys) known.push_back(key.facts.name);
  for (const Entry& entry : node.entries) {
    const auto key = std::find(known.begin(), known.end(), snake(entry.key));
    if (key == known.end()) {
      mistakes.add(entry.place, unknown_name("key", entry.key, known));
    } else {
      check_value(entry.value, block.keys[static_cast<size_t>(key - known.begin())], mistakes);
    }
  }
  for (const Key& key : block.keys) {
    if (!key.required || node.find(key.facts.name)) continue;
    mistakes.add(node.place,
                 fmt::format("key '{}' is missing: {}", key.facts.name, key.facts.meaning));
  }
}

bool is_name_letter(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '-';
}

std::string substituted(const Node& node, const std::map<std::string, std::string>& vars,
                        Mistakes& mistakes) {
  std::string result;
  const std::string& from = node.text;
  for (size_t i = 0; i < from.size();) {
    const size_t close = from[i] == '{' ? from.find('}', i) : std::string::npos;
    const std::string name = close == std::string::npos ? "" : from.substr(i + 1, close - i - 1);
    if (name.empty() || !std::all_of(name.begin(), name.end(), is_name_letter)) {
      result += from[i++];
      continue;
    }
    i = close + 1;
    const auto found = vars.find(snake(name));
    if (name == "set" || name == "udim" || name == "suffix") {
      result += "{" + name + "}";
    } else if (found != vars.end()) {
      result += found->second;
    } else {
      std::vector<std::string> known{"set", "udim", "suffix"};
      for (const auto& var : vars) known.push_back(var.first);
      mistakes.add(node.place, unknown_name("variable", name, known));
    }
  }
  return result;
}

}  // namespace

void check(const Node& node, const std::string& block, Mistakes& mistakes) {
  check_block(node, block, mistakes);
}

void substitute(Node& node, const std::map<std::string, std::string>& vars, Mistakes& mistakes) {
  if (node.kind == Node::Kind::Scalar) node.text = substituted(node, vars, mistakes);
  for (Node& item : node.items) substitute(item, vars, mistakes);
  for (Entry& entry : node.entries) {
    if (entry.key != "vars") substitute(entry.value, vars, mistakes);
  }
}

}  // namespace kiln

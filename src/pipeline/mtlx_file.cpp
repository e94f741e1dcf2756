// SPDX-License-Identifier: Apache-2.0
#include "mtlx_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "kiln/core/error.h"
#include "kiln/core/param.h"
#include "kiln/io/image_bytes.h"

namespace kiln {
namespace {

namespace fs = std::filesystem;

std::string attribute(pugi::xml_node node, const char* name) {
  return node.attribute(name).value();
}

pugi::xml_node named(pugi::xml_node parent, const std::string& name) {
  for (const pugi::xml_node child : parent.children()) {
    if (attribute(child, "name") == name) return child;
  }
  return {};
}

// "0.8, 0.7, 0.6" or "0.8"; a single number stands for all three.
std::array<float, 3> numbers_of(const std::string& text) {
  ParamFacts facts;
  facts.name = "value";
  std::vector<float> numbers;
  for (size_t begin = 0; begin <= text.size() && numbers.size() < 4;) {
    const size_t comma = std::min(text.find(',', begin), text.size());
    const size_t first = std::min(text.find_first_not_of(" \t\n", begin), comma);
    const size_t last = text.find_last_not_of(" \t\n", comma == 0 ? 0 : comma - 1);
    const std::string word =
        last == std::string::npos || last < first ? "" : text.substr(first, last - first + 1);
    numbers.push_back(static_cast<float>(parse_number(facts, word)));
    begin = comma + 1;
  }
  if (numbers.size() == 1) numbers.resize(3, numbers[0]);
  numbers.resize(3, 0.0f);
  return {numbers[0], numbers[1], numbers[2]};
}

// "x", "r", "outr", "outx" and the index 0 are the channel r, and so on.
char channel_letter(const std::string& name) {
  if (name.empty()) return '\0';
  static const std::map<char, char> letters = {{'x', 'r'}, {'y', 'g'}, {'z', 'b'}, {'w', 'a'},
                                               {'r', 'r'}, {'g', 'g'}, {'b', 'b'}, {'a', 'a'},
                                               {'0', 'r'}, {'1', 'g'}, {'2', 'b'}, {'3', 'a'}};
  const auto found = letters.find(name.back());
  const bool fits = name.size() == 1 || (name.size() == 4 && name.starts_with("out"));
  return found == letters.end() || !fits ? '\0' : found->second;
}

std::string kiln_space(const std::string& space) {
  static const std::map<std::string, std::string> spaces = {{"srgb_texture", "srgb_rec709_scene"},
                                                            {"lin_rec709", "lin_rec709_scene"},
                                                            {"acescg", "lin_ap1_scene"},
                                                            {"lin_ap1", "lin_ap1_scene"},
                                                            {"none", ""}};
  const auto found = spaces.find(space);
  return found == spaces.end() ? space : found->second;
}

std::string channels_of_type(const std::string& type) {
  if (type == "float") return "r";
  return type == "vector2" ? "rg" : "rgb";
}

bool is_image(const std::string& category) {
  static const std::set<std::string> images = {"image", "tiledimage", "gltf_image",
                                               "gltf_colorimage", "gltf_normalmap"};
  return images.count(category) > 0;
}

}  // namespace

MtlxFile::MtlxFile(const fs::path& path) : path_(path) {
  const std::vector<uint8_t> bytes = read_bytes(path);
  text_.assign(bytes.begin(), bytes.end());
  const pugi::xml_parse_result parsed = document_.load_buffer(text_.data(), text_.size());
  if (!parsed) {
    const auto end = text_.begin() + std::min<std::ptrdiff_t>(
                                         parsed.offset, static_cast<std::ptrdiff_t>(text_.size()));
    throw Error(Fault::Input,
                fmt::format("{}:{}: this is not XML: {}", path.string(),
                            std::count(text_.begin(), end, '\n') + 1, parsed.description()));
  }
  if (std::string(root().name()) != "materialx") {
    refuse(root(), fmt::format("found <{}>, expected <materialx>", root().name()));
  }
}

void MtlxFile::refuse(pugi::xml_node at, const std::string& message) const {
  const auto offset =
      std::clamp<std::ptrdiff_t>(at.offset_debug(), 0, static_cast<std::ptrdiff_t>(text_.size()));
  const auto line = std::count(text_.begin(), text_.begin() + offset, '\n') + 1;
  throw Error(Fault::Input, fmt::format("{}:{}: {}", path_.string(), line, message));
}

pugi::xml_node MtlxFile::input_of(pugi::xml_node node, const std::string& name) {
  for (const pugi::xml_node input : node.children("input")) {
    if (attribute(input, "name") == name) return input;
  }
  return {};
}

pugi::xml_node MtlxFile::node_of(pugi::xml_node input) const {
  const std::string name = attribute(input, "nodename");
  const pugi::xml_node owner = input.parent();
  const bool in_graph = std::string(input.name()) == "output";
  const pugi::xml_node scope = in_graph ? owner : owner.parent();
  const pugi::xml_node near = named(scope, name);
  const pugi::xml_node found = near ? near : named(root(), name);
  if (!found) refuse(input, fmt::format("node '{}' is not in this file", name));
  return found;
}

MtlxSource MtlxFile::source_of(pugi::xml_node input) const {
  return follow(input, {attribute(input, "name"), 0});
}

MtlxSource MtlxFile::follow(pugi::xml_node from, Walk walk) const {
  if (++walk.depth > 32) refuse(from, fmt::format("{} goes round in a circle", walk.feeds));
  const std::string channels = attribute(from, "channels");
  if (const std::string name = attribute(from, "interfacename"); !name.empty()) {
    pugi::xml_node graph = from.parent();
    while (graph && std::string(graph.name()) != "nodegraph") graph = graph.parent();
    const pugi::xml_node outer = input_of(graph, name);
    if (!outer) refuse(from, fmt::format("the graph has no input '{}'", name));
    return picked(follow(outer, walk), channels, from);
  }
  if (const std::string name = attribute(from, "nodegraph"); !name.empty()) {
    const pugi::xml_node graph = named(root(), name);
    if (!graph) refuse(from, fmt::format("nodegraph '{}' is not in this file", name));
    return picked(of_graph(graph, from, walk), channels, from);
  }
  if (from.attribute("nodename")) {
    const pugi::xml_node node = node_of(from);
    const bool graph = std::string(node.name()) == "nodegraph";
    const std::string output = attribute(from, "output");
    return picked(graph ? of_graph(node, from, walk) : of_node(node, output, walk), channels, from);
  }
  if (!from.attribute("value")) {
    refuse(from, fmt::format("'{}' has neither a value nor a connection", attribute(from, "name")));
  }
  return of_constant(from);
}

MtlxSource MtlxFile::of_graph(pugi::xml_node graph, pugi::xml_node from, Walk walk) const {
  const std::string name = attribute(from, "output");
  for (const pugi::xml_node output : graph.children("output")) {
    if (name.empty() || attribute(output, "name") == name) return follow(output, walk);
  }
  refuse(from, fmt::format("nodegraph '{}' has no output '{}'", attribute(graph, "name"), name));
}

MtlxSource MtlxFile::of_node(pugi::xml_node node, const std::string& output, Walk walk) const {
  const std::string category = node.name();
  const auto through = [&](const char* name) {
    const pugi::xml_node input = input_of(node, name);
    if (!input) refuse(node, fmt::format("'{}' has no input '{}'", attribute(node, "name"), name));
    return follow(input, walk);
  };
  if (is_image(category)) return of_image(node, output);
  if (category == "constant") return through("value");
  if (category == "dot" || category == "convert") return through("in");
  if (category == "extract") {
    const pugi::xml_node index = input_of(node, "index");
    return picked(through("in"), index ? attribute(index, "value") : "0", node);
  }
  if (category == "swizzle") {
    return picked(through("in"), attribute(input_of(node, "channels"), "value"), node);
  }
  if (category.starts_with("separate")) return picked(through("in"), output, node);
  if (category == "normalmap") {
    MtlxSource source = through("in");
    if (const pugi::xml_node scale = input_of(node, "scale")) {
      const MtlxSource factor = follow(scale, walk);
      if (!factor.path.empty()) refuse(scale, "the scale of a normal map is read as a constant");
      source.normal_scale *= factor.value[0];
    }
    return source;
  }
  refuse(node, fmt::format("node '{}' ({}) feeds {}: only images and constants are read",
                           attribute(node, "name"), category, walk.feeds));
}

MtlxSource MtlxFile::of_image(pugi::xml_node node, const std::string& output) const {
  pugi::xml_node file = input_of(node, "file");
  if (const std::string name = attribute(file, "interfacename"); !name.empty()) {
    file = input_of(node.parent(), name);
  }
  std::string name = attribute(file, "value");
  if (name.empty()) {
    refuse(node, fmt::format("'{}' names no file", attribute(node, "name")));
  }
  for (pugi::xml_node at = file; at; at = at.parent()) name = attribute(at, "fileprefix") + name;
  std::replace(name.begin(), name.end(), '\\', '/');
  if (name.find("://") != std::string::npos) {
    refuse(node, fmt::format("'{}' would have to be fetched; expected a file", name));
  }
  MtlxSource source;
  source.path = (path_.parent_path() / name).lexically_normal();
  source.channels = channels_of_type(attribute(node, "type"));
  source.color_space = color_space_of(file);
  if (output == "outa") source.channels = "a";
  if (const pugi::xml_node scale = input_of(node, "normal_scale")) {
    source.normal_scale = numbers_of(attribute(scale, "value"))[0];
  }
  const std::string mode = attribute(input_of(node, "uaddressmode"), "value");
  source.wrap = mode == "clamp" ? Wrap::Clamp : mode == "mirror" ? Wrap::Mirror : Wrap::Repeat;
  return source;
}

MtlxSource MtlxFile::of_constant(pugi::xml_node at) const {
  MtlxSource source;
  source.value = with_context(path_.string() + ": " + attribute(at, "name"),
                              [&] { return numbers_of(attribute(at, "value")); });
  source.color_space = color_space_of(at);
  return source;
}

MtlxSource MtlxFile::picked(MtlxSource source, const std::string& channels,
                            pugi::xml_node at) const {
  if (channels.empty() || channels == "rgb" || channels == "xyz") return source;
  const char letter = channel_letter(channels);
  const size_t place = std::string_view("rgba").find(letter);
  if (letter == '\0')
    refuse(at, fmt::format("channels '{}': expected one of r, g, b, a", channels));
  if (!source.path.empty()) {
    source.channels = std::string(1, letter);
  } else {
    source.value.fill(place < 3 ? source.value[place] : 1.0f);
  }
  return source;
}

std::string MtlxFile::color_space_of(pugi::xml_node at) const {
  for (; at; at = at.parent()) {
    if (at.attribute("colorspace")) return kiln_space(attribute(at, "colorspace"));
  }
  return "";
}

}  // namespace kiln

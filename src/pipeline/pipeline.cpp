// SPDX-License-Identifier: Apache-2.0
#include "kiln/pipeline/pipeline.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

#include "block_reading.h"
#include "kiln/core/error.h"
#include "kiln/pipeline/schema.h"
#include "map_keys.h"

namespace kiln {
namespace {

namespace fs = std::filesystem;

// Blocks are read after check() found no mistake in their shape, so reading them is plain; what
// only the meaning of a word can show is still added to the mistakes.
struct Reading {
  fs::path folder;  ///< of the file
  Mistakes& mistakes;
};

// A block, or the scalar that stands for its key `path`.
std::string path_text(const Node& node) {
  return node.kind == Node::Kind::Scalar ? node.text : text_at(node, "path");
}

size_t index_of(const std::string& text, const std::vector<std::string>& words) {
  const auto found = std::find(words.begin(), words.end(), kebab(text));
  return static_cast<size_t>(found - words.begin());
}

template <class Names>
std::vector<std::string> words(const Names& names) {
  return {names.begin(), names.end()};
}

ColorChoice read_color(const Node& node, const Reading& reading) {
  ColorChoice color;
  color.config = text_at(node, "config");
  if (color.config == "$OCIO") {
    color.config = chosen_config("", "");
  } else if (!color.config.empty() && color.config != "builtin") {
    color.config = joined(reading.folder, color.config).string();
  }
  color.working = text_at(node, "working", color.working);
  with(node, "on_conversion", [&](const Node& word) {
    color.on_conversion =
        static_cast<ColorChoice::OnConversion>(index_of(word.text, {"allow", "warn", "refuse"}));
  });
  return color;
}

EnvironmentChoice read_environment(const Entry& entry, const Reading& reading) {
  EnvironmentChoice environment;
  environment.name = entry.key;
  environment.place = entry.value.place;
  environment.path = joined(reading.folder, path_text(entry.value));
  environment.color_space = text_at(entry.value, "color_space");
  environment.projection = static_cast<Arrangement>(
      index_of(text_at(entry.value, "projection", "auto"), words(arrangement_names)));
  environment.mirror =
      static_cast<Mirror>(index_of(text_at(entry.value, "mirror", "none"), words(mirror_names)));
  environment.up = static_cast<Up>(index_of(text_at(entry.value, "up", "y"), words(up_names)));
  environment.rotate = parse_number({}, text_at(entry.value, "rotate", "0"));
  environment.fix = kebab(text_at(entry.value, "fix", environment.fix));
  return environment;
}

// A constant is easily written where a file is named.
void refuse_number(const std::string& key, const std::string& path) {
  if (path.empty() || path.find_first_not_of("0123456789.-+e") != std::string::npos) return;
  throw Error(Fault::Usage,
              fmt::format("{}: found '{}', expected a file, or {{ value: {} }}", key, path, path));
}

MapChoice read_map(Slot slot, const Entry& entry, const Reading& reading) {
  MapChoice map;
  map.slot = slot;
  map.place = entry.value.place;
  attempt(reading.mistakes, map.place, [&] {
    read_map_keys(entry.value, map);
    const std::string path = path_text(entry.value);
    if (path.empty() == !map.value.has_value()) {
      throw Error(Fault::Usage, fmt::format("{}: expected either a path or a value", entry.key));
    }
    refuse_number(entry.key, path);
    if (!path.empty()) map.path = joined(reading.folder, path);
  });
  return map;
}

std::vector<MapChoice> read_maps(const Node& node, const Reading& reading) {
  std::vector<MapChoice> maps;
  std::map<Slot, std::string> seen;
  for (const Entry& entry : node.entries) {
    attempt(reading.mistakes, entry.place, [&] {
      const Slot slot = parse_slot(entry.key);
      const auto [first, fresh] = seen.emplace(slot, entry.key);
      if (!fresh) {
        throw Error(Fault::Usage,
                    fmt::format("'{}' fills the same slot as '{}'", entry.key, first->second));
      }
      maps.push_back(read_map(slot, entry, reading));
    });
  }
  return maps;
}

void read_reading(const Node& node, SetChoice& set) {
  for (const Param<WorkflowSettings>& param : workflow_params()) {
    if (param.facts.name == "workflow") continue;
    with(node, param.facts.name, [&](const Node& word) { param.assign(set.reading, word.text); });
  }
  with(node, "alpha_cutoff", [&](const Node& at) { set.alpha_cutoff = parse_number({}, at.text); });
  with(node, "workflow", [&](const Node& word) {
    if (kebab(word.text) != "auto") set.workflow = parse_workflow(word.text);
  });
}

void refuse_other_keys(const Node& node, const std::vector<std::string>& known,
                       const std::string& reason, const Reading& reading) {
  for (const Entry& entry : node.entries) {
    if (std::count(known.begin(), known.end(), snake(entry.key)) > 0) continue;
    reading.mistakes.add(entry.place, fmt::format("{}: {}", entry.key, reason));
  }
}

SetChoice read_set(const Node& node, const Reading& reading) {
  SetChoice set;
  set.place = node.place;
  set.name = text_at(node, "name");
  with(node, "glob", [&](const Node& at) { set.glob = joined(reading.folder, at.text).string(); });
  with(node, "path", [&](const Node& at) { set.path = joined(reading.folder, at.text); });
  set.material = text_at(node, "material");
  with(node, "packed", [&](const Node& at) {
    attempt(reading.mistakes, at.place,
            [&] { set.packed = layout_text(one_text(at), reading.folder); });
  });
  with(node, "maps", [&](const Node& maps) { set.maps = read_maps(maps, reading); });
  with(node, "naming", [&](const Node& names) { set.naming = scalars(names); });
  read_reading(node, set);
  const int sources = int{node.find("glob") != nullptr} + int{node.find("path") != nullptr} +
                      int{node.find("maps") != nullptr};
  if (sources != 1) reading.mistakes.add(node.place, "a set needs one of: glob, path, maps");
  if (!set.material.empty() && !is_material_document(set.path)) {
    reading.mistakes.add(node.place, "a `material` is one of a .gltf, .glb or .mtlx file");
  }
  if (!set.packed.empty() && set.path.empty()) {
    reading.mistakes.add(node.place, "`packed` is the layout of an image that `path` names");
  }
  if (is_material_file(set.path) || is_material_file(set.glob)) {
    refuse_other_keys(node, {"glob", "path", "name"}, "a material file says itself how it is read",
                      reading);
  }
  if (!set.glob.empty() && !set.name.empty()) {
    reading.mistakes.add(node.place, "a glob makes many sets and cannot have one name");
  }
  if (node.find("maps") && set.name.empty()) {
    reading.mistakes.add(node.place, "a set made of maps needs a name");
  }
  return set;
}

MaterialChoice read_material(const Node& node) {
  MaterialChoice material;
  material.place = node.place;
  const std::string workflow = text_at(node, "workflow", "auto");
  if (kebab(workflow) != "auto") material.workflow = parse_workflow(workflow);
  with(node, "specular",
       [&](const Node& word) { material.specular = parse_specular_encoding(word.text); });
  for (const Param<SurfaceChoice>& param : surface_params()) {
    with(node, param.facts.name,
         [&](const Node& word) { param.assign(material.surface, word.text); });
  }
  return material;
}

PixelType pixel_type(const std::string& word) {
  return static_cast<PixelType>(index_of(word, pixel_type_words()));
}

// True when the key is one of the runner's own.
bool read_runner_key(const Entry& entry, BakeChoice& bake) {
  const std::string key = snake(entry.key);
  const std::string& text = entry.value.text;
  if (key == "bake") return true;
  if (key == "out") return bake.out = text, true;
  if (key == "env") return bake.env = text, bake.env_place = entry.value.place, true;
  if (key == "type") return bake.output.type = pixel_type(text), true;
  if (key == "display") return bake.output.display.display = text, true;
  if (key == "view_transform") return bake.output.display.view = text, true;
  if (key == "exposure") return bake.output.display.exposure = parse_number({}, text), true;
  return false;
}

const BakeFacts* facts_of_bake(const std::string& bake) {
  const auto& all = all_bakes();
  const auto found = std::find_if(all.begin(), all.end(),
                                  [&](const BakeFacts& facts) { return facts.name == bake; });
  return found == all.end() ? nullptr : &*found;
}

bool takes(const BakeFacts& facts, const std::string& key) {
  return std::any_of(facts.params.begin(), facts.params.end(),
                     [&](const ParamFacts& param) { return param.name == key; });
}

BakeChoice read_bake(const Node& node, const Reading& reading) {
  BakeChoice bake;
  bake.place = node.place;
  bake.bake = kebab(text_at(node, "bake"));
  const BakeFacts* facts = facts_of_bake(bake.bake);
  for (const Entry& entry : node.entries) {
    const std::string key = snake(entry.key);
    const bool is_own = facts && takes(*facts, key);
    if (!is_own && read_runner_key(entry, bake)) continue;
    std::string text = one_text(entry.value);
    if (is_own && key == facts->layout) {
      attempt(reading.mistakes, entry.value.place,
              [&] { text = layout_text(text, reading.folder); });
    }
    bake.settings.push_back({key, text, entry.value.place});
  }
  return bake;
}

std::map<std::string, std::string> read_vars(
    const Node& root, const std::vector<std::pair<std::string, std::string>>& over,
    Mistakes& mistakes) {
  std::map<std::string, std::string> vars;
  std::vector<std::string> known;
  with(root, "vars", [&](const Node& node) {
    for (const Entry& entry : node.entries) {
      if (snake(entry.key) == "set" || snake(entry.key) == "udim" || snake(entry.key) == "suffix") {
        mistakes.add(entry.place, fmt::format("'{}' is what a texture set is called; choose "
                                              "another variable",
                                              entry.key));
      }
      vars[snake(entry.key)] = entry.value.text;
      known.push_back(entry.key);
    }
  });
  for (const auto& [key, value] : over) {
    if (!vars.count(snake(key))) {
      throw Error(Fault::Usage, "--set: " + unknown_name("variable", key, known));
    }
    vars[snake(key)] = value;
  }
  return vars;
}

Pipeline read_root(const Node& root, const Reading& reading) {
  Pipeline pipeline;
  pipeline.name = text_at(root, "name");
  with(root, "color", [&](const Node& node) { pipeline.color = read_color(node, reading); });
  with(root, "limits", [&](const Node& node) {
    const std::string memory = text_at(node, "memory");
    if (memory.empty()) return;
    attempt(reading.mistakes, node.place,
            [&] { pipeline.max_memory = parse_bytes("memory", memory); });
  });
  with(root, "environment", [&](const Node& node) {
    for (const Entry& entry : node.entries) {
      pipeline.environments.push_back(read_environment(entry, reading));
    }
  });
  with(root, "sets", [&](const Node& node) {
    for (const Node& item : node.items) pipeline.sets.push_back(read_set(item, reading));
  });
  with(root, "material", [&](const Node& node) { pipeline.material = read_material(node); });
  with(root, "bakes", [&](const Node& node) {
    for (const Node& item : node.items) pipeline.bakes.push_back(read_bake(item, reading));
  });
  return pipeline;
}

Node checked_block(const std::vector<std::pair<std::string, std::string>>& keys,
                   const std::string& name) {
  Node block;
  block.kind = Node::Kind::Block;
  for (const auto& [key, text] : keys) {
    Entry& entry = block.entries.emplace_back();
    entry.key = key;
    entry.value.kind = Node::Kind::Scalar;
    entry.value.text = text;
  }
  Mistakes mistakes;
  check(block, name, mistakes);
  mistakes.raise();
  return block;
}

}  // namespace

BakeChoice bake_choice(const std::vector<std::pair<std::string, std::string>>& keys) {
  Mistakes mistakes;
  BakeChoice bake = read_bake(checked_block(keys, "bake"), {{}, mistakes});
  mistakes.raise();
  return bake;
}

EnvironmentChoice environment_choice(const std::string& name,
                                     const std::vector<std::pair<std::string, std::string>>& keys) {
  Entry entry;
  entry.key = name;
  entry.value = checked_block(keys, "environment");
  Mistakes mistakes;
  return read_environment(entry, {{}, mistakes});
}

std::string chosen_config(const std::string& asked_for, const std::string& of_file) {
  if (!asked_for.empty()) return asked_for;
  if (!of_file.empty()) return of_file;
  const char* named = std::getenv("OCIO");
  return named && *named ? named : "builtin";
}

fs::path joined(const fs::path& folder, const std::string& path) {
  return (folder / path).lexically_normal();
}

Pipeline read_pipeline(const fs::path& file,
                       const std::vector<std::pair<std::string, std::string>>& vars) {
  Node root = read_document(file);
  Mistakes mistakes;
  substitute(root, read_vars(root, vars, mistakes), mistakes);
  check(root, "pipeline", mistakes);
  mistakes.raise();
  Pipeline pipeline = read_root(root, {file.parent_path(), mistakes});
  mistakes.raise();
  pipeline.file = file;
  return pipeline;
}

bool is_material_file(const fs::path& path) {
  const std::string extension = path.extension().string();
  return extension == ".yaml" || extension == ".yml" || extension == ".json";
}

MaterialFile read_material_file(const fs::path& file) {
  const Node root = read_document(file);
  Mistakes mistakes;
  check(root, "material-file", mistakes);
  mistakes.raise();
  const Reading reading{file.parent_path(), mistakes};
  MaterialFile result;
  result.set.place = root.place;
  result.set.name = text_at(root, "name", file.stem().string());
  result.set.maps = read_maps(*root.find("maps"), reading);
  read_reading(root, result.set);
  with(root, "material", [&](const Node& node) {
    result.material = read_material(node);
    for (const Param<SurfaceChoice>& param : surface_params()) {
      if (node.find(param.facts.name) != nullptr) result.models.push_back(param.facts.name);
    }
  });
  mistakes.raise();
  return result;
}

}  // namespace kiln

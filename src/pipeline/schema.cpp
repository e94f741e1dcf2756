// SPDX-License-Identifier: Apache-2.0
#include "kiln/pipeline/schema.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "kiln/image/arrangement.h"
#include "kiln/material/naming.h"

namespace kiln {
namespace {

using Kind = ParamFacts::Kind;
using Shape = Key::Shape;

Key scalar(std::string name, Kind kind, std::string meaning, std::string initial = {}) {
  Key key;
  key.facts.name = std::move(name);
  key.facts.kind = kind;
  key.facts.meaning = std::move(meaning);
  key.facts.default_text = std::move(initial);
  return key;
}

Key text(std::string name, std::string meaning, std::string initial = {}) {
  return scalar(std::move(name), Kind::Text, std::move(meaning), std::move(initial));
}

Key word(std::string name, std::vector<std::string> choices, std::string initial,
         std::string meaning) {
  Key key = scalar(std::move(name), Kind::Word, std::move(meaning), std::move(initial));
  key.facts.choices = std::move(choices);
  return key;
}

Key shaped(std::string name, Shape shape, std::string block, std::string meaning) {
  Key key = text(std::move(name), std::move(meaning));
  key.shape = shape;
  key.block = std::move(block);
  return key;
}

Key required(Key key) {
  key.required = true;
  return key;
}

Key listed(Key key) {
  key.shape = Shape::Scalars;
  return key;
}

Key number(std::string name, Range range, std::string unit, std::string meaning,
           std::string initial) {
  Key key = scalar(std::move(name), Kind::Number, std::move(meaning), std::move(initial));
  key.facts.min = range.min;
  key.facts.max = range.max;
  key.facts.unit = std::move(unit);
  return key;
}

template <class Names>
std::vector<std::string> words(const Names& names) {
  return {names.begin(), names.end()};
}

std::vector<std::string> workflow_words() {
  std::vector<std::string> choices = {"auto"};
  for (const std::string_view name : workflow_names) choices.emplace_back(name);
  return choices;
}

std::vector<std::string> naming_words() {
  std::vector<std::string> choices;
  for (const NamingScheme& scheme : all_naming_schemes()) choices.emplace_back(scheme.name);
  return choices;
}

Key version_key() {
  Key key = scalar("version", Kind::Integer, "version of this format: 1");
  key.facts.min = key.facts.max = 1;
  return key;
}

// How the maps of one set are read; the workflow may also be left to a guess.
BlockFacts with_reading_keys(BlockFacts block) {
  block.keys.push_back(
      word("workflow", workflow_words(), "", "instead of the workflow under `material`"));
  block.keys.push_back(
      number("alpha_cutoff", {0, 1}, "", "of a cutout: opacity below which it has holes", ""));
  for (const Param<WorkflowSettings>& param : workflow_params()) {
    if (param.facts.name != "workflow") block.keys.push_back({param.facts});
  }
  return block;
}

BlockFacts pipeline_block() {
  return {"pipeline",
          "which bakes to run on which textures",
          {required(version_key()), text("name", "name of the pipeline"),
           shaped("vars", Shape::Named, "", "texts that \"{name}\" stands for elsewhere"),
           shaped("color", Shape::Block, "color", "colour management"),
           shaped("limits", Shape::Block, "limits", "what a run may take"),
           shaped("environment", Shape::Named, "environment", "environments, by name"),
           shaped("sets", Shape::Blocks, "set", "texture sets"),
           shaped("material", Shape::Block, "material", "the model that the maps feed"),
           required(shaped("bakes", Shape::Blocks, "bake", "what to make"))}};
}

BlockFacts color_block() {
  return {"color",
          "colour management",
          {text("config", "builtin, the path of an OpenColorIO config, or $OCIO", "builtin"),
           text("working", "colour space that everything is computed in", "lin_rec709_scene"),
           word("on_conversion", {"allow", "warn", "refuse"}, "warn",
                "what to do when a map's own colour tag contradicts the space it is read in")}};
}

BlockFacts limits_block() {
  return {"limits",
          "what a run may take",
          {text("memory", "of the whole process: 4GiB; bakes read narrower bands to keep it")}};
}

BlockFacts environment_block() {
  return {"environment",
          "an image, or six, of distant light",
          {required(text("path",
                         "image file, relative to this file; of six faces the name with <FACE> in "
                         "it, or their folder")),
           text("color_space", "its colour space, if not by type: float linear, integers sRGB"),
           word("projection", words(arrangement_names), "auto",
                "how the sphere lies in it; auto: what the file says of itself, else by the ratio "
                "of its sides"),
           word("mirror", words(mirror_names), "none",
                "x: exchanges +X and -X, for images of the other handedness"),
           word("up", words(up_names), "y", "z: its +Z points up and becomes +Y"),
           number("rotate", {}, "[degree]", "turns the environment, positive +Z toward +X", "0"),
           word("fix", {"none", "zero", "neighbors"}, "neighbors",
                "what becomes of texels that are NaN or infinite; none: an error")},
          "path"};
}

BlockFacts set_block() {
  BlockFacts block{
      "set",
      "one texture set, or one per folder that a pattern matches",
      {text("glob", "pattern (* and ?) of folders, each a set, or of files as `path` takes them"),
       text("path",
            "one folder, or a material file, a set; or a glTF or MaterialX file, a set a material; "
            "or a packed image"),
       listed(text("packed", "layout of that image, as bake pack takes one")),
       text("material", "the one material of that file that is wanted"),
       text("name", "name of the set"),
       shaped("maps", Shape::Named, "map", "files by slot, instead of a folder"),
       listed(word("naming", naming_words(), "", "naming schemes to try, in order"))}};
  return with_reading_keys(std::move(block));
}

std::vector<std::string> encoding_words() {
  std::vector<std::string> all = words(specular_encoding_names);
  for (const auto& more : {words(roughness_encoding_names), words(anisotropy_encoding_names),
                           words(angle_encoding_names)}) {
    all.insert(all.end(), more.begin(), more.end());
  }
  return all;
}

BlockFacts map_block() {
  return {
      "map",
      "where the values of a slot come from: a file or a constant",
      {text("path", "image file, relative to this file"),
       word("channel", {"r", "g", "b", "a", "rgb", "rg"}, "", "what to take of the file"),
       word("convention", words(normal_convention_names), "auto", "of a normal map"),
       text("color_space", "colour space of a colour map, if not by type"),
       listed(text("value", "a constant instead of a file: one number, or three")),
       word("encoding", encoding_words(), "",
            "what the number of a specular_level, roughness, anisotropy or anisotropy_angle is"),
       listed(text("scale", "factor of the values, one or three; of a colour, linear", "1")),
       listed(text("offset", "added after that", "0"))},
      "path"};
}

BlockFacts material_block() {
  BlockFacts block{"material",
                   "the model that the maps feed",
                   {word("workflow", workflow_words(), "auto", "which maps there are"),
                    word("specular", words(specular_encoding_names), "",
                         "what the numbers of a specular map are")}};
  for (const Param<SurfaceChoice>& param : surface_params()) block.keys.push_back({param.facts});
  return block;
}

BlockFacts any_bake_block() {
  return {"bake",
          "one thing to make",
          {required(text("bake", "name of the bake")),
           required(text("out", "file or folder below the output folder; \"{set}\" is the set"))}};
}

BlockFacts material_file_block() {
  BlockFacts block{"material-file",
                   "one texture set in a file of its own",
                   {version_key(), text("name", "name of the set"),
                    required(shaped("maps", Shape::Named, "map", "files by slot")),
                    shaped("material", Shape::Block, "material", "the model that the maps feed")}};
  return with_reading_keys(std::move(block));
}

BlockFacts layouts_file_block() {
  return {"layouts-file",
          "layouts of packed files",
          {version_key(), required(shaped("layouts", Shape::Named, "layout", "layouts by name"))}};
}

BlockFacts layout_block() {
  return {"layout",
          "files, and what their channels hold",
          {text("summary", "what it is for"),
           required(shaped("files", Shape::Named, "", "by name: base_color, opacity"))}};
}

}  // namespace

const std::vector<BlockFacts>& all_blocks() {
  static const std::vector<BlockFacts> blocks = {
      pipeline_block(),      color_block(),        limits_block(),   environment_block(),
      set_block(),           map_block(),          material_block(), any_bake_block(),
      material_file_block(), layouts_file_block(), layout_block()};
  return blocks;
}

const BlockFacts& block_named(const std::string& name) {
  const auto& blocks = all_blocks();
  const auto found = std::find_if(blocks.begin(), blocks.end(),
                                  [&](const BlockFacts& block) { return block.name == name; });
  if (found == blocks.end()) throw Error(Fault::Internal, "no block is named " + name);
  return *found;
}

std::vector<Key> output_keys(Product product) {
  std::vector<std::string> types = pixel_type_words();
  if (product == Product::Picture) types.resize(4);
  if (product == Product::Folder) return {};  // a bake of several files says itself what they hold
  std::vector<Key> keys = {
      word("type", std::move(types), "", "numbers of the file, if not the format's usual")};
  if (product != Product::Picture) return keys;
  keys.push_back(text("display", "OpenColorIO display, for png and jpg", "the config's own"));
  keys.push_back(text("view_transform", "view of that display", "the display's own"));
  keys.push_back(number("exposure", {-100, 100}, "[EV]", "for png and jpg", "0"));
  return keys;
}

std::vector<std::string> pixel_type_words() {
  return {"uint8", "uint16", "half", "float", "rgb10a2", "rgbd8"};
}

BlockFacts bake_block(const BakeFacts& bake) {
  BlockFacts block = block_named("bake");
  block.meaning = bake.summary;
  std::set<std::string> own;
  for (const ParamFacts& param : bake.params) own.insert(param.name);
  std::vector<Key> runner = output_keys(bake.product);
  if (make_recipe(bake.name)->needs().light) {
    Key env = text("env", "name of an environment of this file");
    runner.push_back(bake.own_lights ? std::move(env) : required(std::move(env)));
  }
  for (Key& key : runner) {
    if (!own.count(key.facts.name)) block.keys.push_back(std::move(key));
  }
  for (const ParamFacts& param : bake.params) {
    block.keys.push_back({param, param.kind == Kind::Text ? Shape::Scalars : Shape::Scalar});
  }
  return block;
}

}  // namespace kiln

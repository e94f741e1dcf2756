// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <vector>

#include "kiln/bake/bake.h"
#include "kiln/core/param.h"
#include "kiln/pipeline/document.h"

namespace kiln {

/// A key of a block: the one description that checking, `kiln list schema` and docs follow.
struct Key {
  enum class Shape {
    Scalar,
    Scalars,  ///< a list of scalars, or one
    Block,
    Blocks,  ///< a list of blocks
    Named    ///< names of the user's choice, each with a block; without `block`, with a text
  };
  ParamFacts facts;  ///< name, meaning, and what a scalar may be
  Shape shape = Shape::Scalar;
  std::string block = {};  ///< name of the block it holds
  bool required = false;
};

struct BlockFacts {
  std::string name;
  std::string meaning;
  std::vector<Key> keys;
  std::string shorthand = {};  ///< a scalar in place of the block means this key
};

/// Every block of a pipeline file, a material file and a file of layouts. "pipeline",
/// "material-file" and "layouts-file" are the roots; the keys of "bake" are those of every bake,
/// and a bake's own come from bake_block().
const std::vector<BlockFacts>& all_blocks();

/// @error Fault::Internal when there is none of that name
const BlockFacts& block_named(const std::string& name);

/// The words of the key `type`, in the order of PixelType.
std::vector<std::string> pixel_type_words();

/// The keys that an entry of `bakes` may hold: the runner's own and the parameters of the bake.
BlockFacts bake_block(const BakeFacts& bake);

/// Keys of the runner that say how a file is written, for bakes of that product.
std::vector<Key> output_keys(Product product);

/// Checks a node against the block of that name and all below it: unknown and duplicate keys,
/// missing ones, shapes, words and ranges. Mistakes are added, each with its place.
void check(const Node& node, const std::string& block, Mistakes& mistakes);

/// Replaces "{name}" in every scalar except below the key `vars`; "{set}" and "{udim}" stay for
/// later.
void substitute(Node& node, const std::map<std::string, std::string>& vars, Mistakes& mistakes);

/// The JSON Schema of pipeline files, indented.
std::string schema_json();

}  // namespace kiln

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "kiln/material/normals.h"
#include "kiln/material/slots.h"
#include "kiln/material/workflow.h"

namespace kiln {

/// What one channel, or the colour, of a file is read as.
struct TokenTarget {
  Slot slot;
  std::string_view channels;  ///< "rgb", "r", "g", "b" or "a"
};

/// A token at the end of a file name, and what it says of the file.
struct NamingToken {
  std::string_view token;  ///< as the scheme spells it; matched without case and separators
  std::vector<TokenTarget> targets;
  NormalConvention convention = NormalConvention::Auto;
  bool color_or_level = false;  ///< a specular map whose kind only the rest of the set tells
};

struct NamingScheme {
  std::string_view name;
  std::string_view meaning;
  std::vector<NamingToken> tokens;  ///< where two files claim one slot, the earlier token wins
  NormalConvention convention = NormalConvention::Auto;  ///< of every normal map of such a set
  std::string_view prefix = {};  ///< where all names begin with it, this scheme is tried first
};

/// Every naming scheme there is, in the default order of preference.
const std::vector<NamingScheme>& all_naming_schemes();

/// @error Fault::Usage, naming the nearest known scheme
const NamingScheme& find_naming_scheme(std::string_view name);

/// How one slot of a set is filled, and why.
struct MapSource {
  Slot slot;
  std::string file;      ///< a pattern (udim.h) where the map has tiles
  std::string channels;  ///< "rgb", "r", "g", "b" or "a"
  NormalConvention convention = NormalConvention::Auto;
  bool if_present = false;  ///< an alpha channel that the file need not have
  std::string scheme;
  std::string token;
  std::string reason;              ///< one line: which token of which scheme
  std::string color_space;         ///< a Color Interop name, or "data"
  std::string color_space_reason;  ///< one line
};

struct IgnoredFile {
  std::string file;
  std::string reason;
};

/// A texture set found in a folder.
struct FoundSet {
  std::string name;
  Workflow workflow = Workflow::MetalRough;
  std::string workflow_reason;
  std::vector<MapSource> maps;  ///< in the order of the list of slots, each slot once
  std::vector<IgnoredFile> ignored;
  std::vector<std::string> warnings;
};

struct NamingRules {
  std::vector<std::string> schemes;  ///< in order of preference; empty: all, in their order
  std::optional<Workflow> workflow;  ///< stated by the user; otherwise guessed from the maps
};

/// The texture sets among the files of one folder.
///
/// A file's name is cut into words at separators, changes of case and digits; the last words before
/// resolution, UDIM tile and extension that spell a token decide, the longest token first, then the
/// earlier scheme. Of two files for one slot, a file of its own goes before a channel of a packed
/// one, then the earlier scheme, then the earlier token, then the earlier name; the other is
/// reported. A folder that holds two complete workflows is two sets, NAME.metal_rough and
/// NAME.spec_gloss; one without any map that a BRDF reads is none. UDIM tiles of a map are one file
/// here, its pattern.
///
/// @param files  names without folder
/// @error Fault::Usage for an unknown scheme, naming the nearest
std::vector<FoundSet> find_sets(const std::string& folder_name,
                                const std::vector<std::string>& files,
                                const NamingRules& rules = {});

}  // namespace kiln

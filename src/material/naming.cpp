// SPDX-License-Identifier: Apache-2.0
#include "kiln/material/naming.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <tuple>

#include "kiln/material/udim.h"
#include "name_words.h"
#include "naming_match.h"

namespace kiln {
namespace {

using Schemes = std::vector<const NamingScheme*>;

// One channel or colour of one file, and where its claim on the slot stands.
struct Claim {
  MapSource map;
  bool packed = false;
  size_t scheme = 0;
  size_t token = 0;
  bool color_or_level = false;

  auto rank() const { return std::tie(packed, scheme, token, map.file); }
};

// The slots of which one workflow's set needs some and the other's none.
constexpr std::array<Slot, 2> only_metal_rough = {Slot::BaseColor, Slot::Metallic};
constexpr std::array<Slot, 2> only_spec_gloss = {Slot::Diffuse, Slot::SpecularColor};

bool contains(const auto& slots, Slot slot) {
  return std::find(slots.begin(), slots.end(), slot) != slots.end();
}

bool is_image(const std::string& extension) {
  static const std::set<std::string> known = {".png", ".jpg", ".jpeg", ".exr", ".tif",  ".tiff",
                                              ".hdr", ".tga", ".bmp",  ".tx",  ".webp", ".psd",
                                              ".jp2", ".dpx", ".sgi",  ".pic"};
  return known.count(extension) > 0;
}

bool all_begin_with(std::string_view prefix, const std::vector<std::string>& files) {
  return !prefix.empty() && std::all_of(files.begin(), files.end(), [&](const std::string& file) {
    return file.starts_with(prefix) || !is_image(name_extension(file));
  });
}

// All of them in their order, but that first whose prefix the names have.
Schemes usual_schemes(const std::vector<std::string>& files) {
  Schemes schemes;
  for (const NamingScheme& scheme : all_naming_schemes()) schemes.push_back(&scheme);
  std::stable_partition(schemes.begin(), schemes.end(), [&](const NamingScheme* scheme) {
    return all_begin_with(scheme->prefix, files);
  });
  return schemes;
}

Schemes schemes_of(const std::vector<std::string>& names, const std::vector<std::string>& files) {
  if (names.empty()) return usual_schemes(files);
  Schemes schemes;
  for (const std::string& name : names) schemes.push_back(&find_naming_scheme(name));
  return schemes;
}

std::string scheme_names(const Schemes& schemes) {
  std::vector<std::string_view> names;
  for (const NamingScheme* scheme : schemes) names.push_back(scheme->name);
  return fmt::format("{}", fmt::join(names, ", "));
}

void decide_color_space(MapSource& map) {
  if (slot_facts(map.slot).content == Content::Numbers) {
    map.color_space = "data";
    map.color_space_reason = fmt::format("{} holds numbers, never converted", slot_name(map.slot));
    return;
  }
  const std::string extension = name_extension(map.file);
  const bool linear = extension == ".exr" || extension == ".hdr";
  map.color_space = linear ? "lin_rec709_scene" : "srgb_rec709_scene";
  map.color_space_reason =
      fmt::format("{} is a colour, and {} files are taken as {} unless told otherwise",
                  slot_name(map.slot), extension, linear ? "linear Rec.709" : "sRGB");
}

// What later schemes would have read a token of the same letters as: "; o3de reads it as height".
std::string other_readings(const Schemes& schemes, const TokenMatch& match) {
  const NamingToken& taken = schemes[match.scheme]->tokens[match.token];
  std::map<Slot, std::vector<std::string_view>> readers;
  for (size_t i = match.scheme + 1; i < schemes.size(); ++i) {
    for (const NamingToken& token : schemes[i]->tokens) {
      const Slot slot = token.targets.front().slot;
      if (squeezed(token.token) != squeezed(taken.token)) continue;
      if (slot != taken.targets.front().slot) readers[slot].push_back(schemes[i]->name);
    }
  }
  std::string text;
  for (const auto& [slot, names] : readers) {
    text += fmt::format("; {} {} it as {}", fmt::join(names, ", "),
                        names.size() == 1 ? "reads" : "read", slot_name(slot));
  }
  return text;
}

std::string_view word_of(NormalConvention convention) {
  return normal_convention_names[static_cast<size_t>(convention)];
}

Claim claim_of(const std::string& file, const Schemes& schemes, const TokenMatch& match,
               const TokenTarget& target) {
  const NamingScheme& scheme = *schemes[match.scheme];
  const NamingToken& token = scheme.tokens[match.token];
  Claim claim;
  claim.packed = token.targets.size() > 1;
  claim.scheme = match.scheme;
  claim.token = match.token;
  claim.color_or_level = token.color_or_level;
  MapSource& map = claim.map;
  map.slot = target.slot;
  map.file = file;
  map.channels = target.channels;
  map.scheme = scheme.name;
  map.token = token.token;
  map.reason = fmt::format("token '{}' of scheme {}", token.token, scheme.name);
  if (claim.packed) map.reason += fmt::format(", channel {}", target.channels);
  map.reason += other_readings(schemes, match);
  if (target.slot == Slot::Normal) {
    const bool stated = token.convention != NormalConvention::Auto;
    map.convention = stated ? token.convention : scheme.convention;
    if (map.convention != NormalConvention::Auto) {
      map.reason += "; convention " + std::string(word_of(map.convention));
    }
  }
  return claim;
}

// Why a file cannot be a map at all, or nothing.
std::string not_a_map(const std::string& file) {
  if (file.starts_with(".")) return "hidden file";
  if (!is_image(name_extension(file))) return "not an image";
  for (const NameWord& word : split_words(name_stem(file))) {
    if (is_preview(word.text)) return fmt::format("a picture, not a map ('{}')", word.text);
  }
  return "";
}

struct Claims {
  std::vector<Claim> claims;
  std::vector<IgnoredFile> ignored;
};

Claims claims_of(const std::vector<std::string>& files, const Schemes& schemes) {
  Claims result;
  for (const std::string& file : files) {
    if (const std::string reason = not_a_map(file); !reason.empty()) {
      result.ignored.push_back({file, reason});
      continue;
    }
    const auto match = match_token(name_stem(file), schemes);
    if (!match) {
      result.ignored.push_back(
          {file, fmt::format("its name ends in no token of {}", scheme_names(schemes))});
      continue;
    }
    for (const TokenTarget& target : schemes[match->scheme]->tokens[match->token].targets) {
      result.claims.push_back(claim_of(file, schemes, *match, target));
    }
  }
  return result;
}

void sort_by_rank(std::vector<Claim>& claims) {
  std::sort(claims.begin(), claims.end(), [](const Claim& a, const Claim& b) {
    return a.map.slot != b.map.slot ? a.map.slot < b.map.slot : a.rank() < b.rank();
  });
}

std::vector<Slot> slots_of(const std::vector<Claim>& claims) {
  std::vector<Slot> slots;
  for (const Claim& claim : claims) {
    if (!contains(slots, claim.map.slot)) slots.push_back(claim.map.slot);
  }
  return slots;
}

// `specular` alone says neither colour nor level: the rest of the set does.
void settle_specular(Claims& found, std::optional<Workflow> workflow,
                     std::vector<std::string>& warnings) {
  const std::vector<Slot> slots = slots_of(found.claims);
  const bool metallic = contains(slots, Slot::Metallic);
  const bool spec_gloss = contains(slots, Slot::Diffuse) && contains(slots, Slot::Gloss);
  const bool color = workflow ? *workflow != Workflow::MetalRough : !metallic || spec_gloss;
  for (Claim& claim : found.claims) {
    if (!claim.color_or_level) continue;
    MapSource& map = claim.map;
    map.slot = color ? Slot::SpecularColor : Slot::SpecularLevel;
    map.channels = color ? "rgb" : "r";
    const std::string why = workflow ? fmt::format("workflow {}", workflow_name(*workflow))
                            : metallic && !color ? std::string("a metallic map is beside it")
                            : spec_gloss         ? std::string("diffuse and gloss are beside it")
                                                 : std::string("no metallic map is beside it");
    map.reason += fmt::format("; read as {}: {}", slot_name(map.slot), why);
    if (!workflow && color && !contains(slots, Slot::Gloss)) {
      warnings.push_back(fmt::format(
          "{} is read as specular colour (F0); if it holds a level, state specular_level",
          map.file));
    }
  }
}

bool is_complete_metal_rough(const std::vector<Slot>& slots) {
  return contains(slots, Slot::BaseColor) && contains(slots, Slot::Metallic) &&
         (contains(slots, Slot::Roughness) || contains(slots, Slot::Gloss));
}

bool is_complete_spec_gloss(const std::vector<Slot>& slots) {
  return contains(slots, Slot::Diffuse) && contains(slots, Slot::SpecularColor) &&
         (contains(slots, Slot::Gloss) || contains(slots, Slot::Roughness));
}

// Where the maps of one workflow are all there, those of the other are beside them by accident.
WorkflowGuess more_complete(const std::vector<Slot>& slots) {
  if (is_complete_spec_gloss(slots) && !is_complete_metal_rough(slots)) {
    return {Workflow::SpecGloss, "diffuse, specular colour and gloss or roughness are given"};
  }
  return guess_workflow(slots);
}

// One workflow's maps, incomplete beside those of the one that is read.
void warn_of_the_other(const std::vector<Slot>& slots, Workflow read,
                       std::vector<std::string>& warnings) {
  const bool metal = read == Workflow::MetalRough;
  if (metal ? !is_complete_metal_rough(slots) : !is_complete_spec_gloss(slots)) return;
  const auto& foreign = metal ? only_spec_gloss : only_metal_rough;
  std::vector<std::string_view> found, lacking;
  for (const Slot slot : foreign) {
    (contains(slots, slot) ? found : lacking).push_back(slot_name(slot));
  }
  if (found.empty() || lacking.empty()) return;
  warnings.push_back(fmt::format("{} belongs to another workflow, which lacks {}; {} is read",
                                 fmt::join(found, ", "), fmt::join(lacking, ", "),
                                 workflow_name(read)));
}

// Without the files that belong to the other workflow.
Claims claims_for(const Claims& all, Workflow workflow, const std::string& owner) {
  const auto& foreign = workflow == Workflow::MetalRough ? only_spec_gloss : only_metal_rough;
  std::set<std::string> foreign_files;
  for (const Claim& claim : all.claims) {
    if (contains(foreign, claim.map.slot)) foreign_files.insert(claim.map.file);
  }
  Claims kept{{}, all.ignored};
  for (const Claim& claim : all.claims) {
    if (!foreign_files.count(claim.map.file)) kept.claims.push_back(claim);
  }
  for (const std::string& file : foreign_files) {
    kept.ignored.push_back({file, "belongs to " + owner});
  }
  return kept;
}

std::string why_not(const Claim& claim, const MapSource& taken) {
  return fmt::format("{} is taken from {} (token '{}' of scheme {})", slot_name(claim.map.slot),
                     taken.file, taken.token, taken.scheme);
}

// An alpha channel in a colour map is opacity, as glTF has it, unless opacity has its own file.
void add_opacity_of_color(FoundSet& set) {
  const MapSource* color = nullptr;
  for (const MapSource& map : set.maps) {
    if (map.slot == Slot::Opacity) return;
    const bool colored = map.slot == Slot::BaseColor || map.slot == Slot::Diffuse;
    if (colored && !color) color = &map;
  }
  if (!color) return;
  MapSource opacity = *color;
  opacity.slot = Slot::Opacity;
  opacity.channels = "a";
  opacity.if_present = true;
  opacity.reason = fmt::format("alpha of {}, if the file has one", slot_name(color->slot));
  set.maps.push_back(opacity);
}

// A plain `normal` beside maps of a scheme with one convention follows that scheme.
void adopt_convention(FoundSet& set, const Schemes& schemes) {
  const auto normal = std::find_if(set.maps.begin(), set.maps.end(), [](const MapSource& map) {
    return map.slot == Slot::Normal && map.convention == NormalConvention::Auto;
  });
  if (normal == set.maps.end()) return;
  for (const NamingScheme* scheme : schemes) {
    if (scheme->convention == NormalConvention::Auto) continue;
    for (const MapSource& map : set.maps) {
      if (map.scheme != scheme->name) continue;
      normal->convention = scheme->convention;
      normal->reason += fmt::format("; convention {} as {} is a map of scheme {}",
                                    word_of(scheme->convention), map.file, scheme->name);
      return;
    }
  }
}

void take_first_claims(FoundSet& set, const Claims& found) {
  set.ignored = found.ignored;
  for (const Claim& claim : found.claims) {
    const auto taken = std::find_if(set.maps.begin(), set.maps.end(), [&](const MapSource& map) {
      return map.slot == claim.map.slot;
    });
    if (taken == set.maps.end()) {
      set.maps.push_back(claim.map);
      continue;
    }
    const std::string channel = claim.packed ? fmt::format("channel {}: ", claim.map.channels) : "";
    set.ignored.push_back({claim.map.file, channel + why_not(claim, *taken)});
    if (taken->token == claim.map.token && taken->scheme == claim.map.scheme) {
      set.warnings.push_back(fmt::format("two files for {}: {} is read, {} is not",
                                         slot_name(claim.map.slot), taken->file, claim.map.file));
    }
  }
}

FoundSet make_set(std::string name, const Claims& found, const WorkflowGuess& guess,
                  const Schemes& schemes) {
  FoundSet set;
  set.name = std::move(name);
  set.workflow = guess.workflow;
  set.workflow_reason = guess.reason;
  take_first_claims(set, found);
  adopt_convention(set, schemes);
  add_opacity_of_color(set);
  std::stable_sort(set.maps.begin(), set.maps.end(),
                   [](const MapSource& a, const MapSource& b) { return a.slot < b.slot; });
  for (MapSource& map : set.maps) decide_color_space(map);
  return set;
}

}  // namespace

std::vector<FoundSet> find_sets(const std::string& folder_name,
                                const std::vector<std::string>& files, const NamingRules& rules) {
  const Schemes schemes = schemes_of(rules.schemes, files);
  Claims found = claims_of(with_tile_patterns(files), schemes);
  std::vector<std::string> warnings;
  settle_specular(found, rules.workflow, warnings);
  sort_by_rank(found.claims);
  const std::vector<Slot> slots = slots_of(found.claims);
  if (slots_read(Workflow::MetalRough, slots).empty() &&
      slots_read(Workflow::SpecGloss, slots).empty()) {
    return {};
  }

  std::vector<FoundSet> sets;
  const bool both = is_complete_metal_rough(slots) && is_complete_spec_gloss(slots);
  const auto add = [&](const std::string& name, Workflow workflow, const std::string& owner,
                       const std::string& reason) {
    const Claims claims = both ? claims_for(found, workflow, owner) : found;
    sets.push_back(make_set(name, claims, {workflow, reason}, schemes));
    sets.back().warnings.insert(sets.back().warnings.end(), warnings.begin(), warnings.end());
  };
  if (rules.workflow) {
    add(folder_name, *rules.workflow, "the other workflow", "as stated");
  } else if (both) {
    const std::string metal = folder_name + ".metal_rough";
    const std::string gloss = folder_name + ".spec_gloss";
    const std::string reason = "the folder holds two complete workflows";
    add(metal, Workflow::MetalRough, gloss, reason);
    add(gloss, Workflow::SpecGloss, metal, reason);
  } else {
    const WorkflowGuess guess = more_complete(slots);
    warn_of_the_other(slots, guess.workflow, warnings);
    add(folder_name, guess.workflow, "", guess.reason);
  }
  return sets;
}

}  // namespace kiln

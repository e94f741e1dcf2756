// SPDX-License-Identifier: Apache-2.0
#include "sets.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <map>

#include "glob.h"
#include "kiln/core/names.h"
#include "material_documents.h"
#include "packed_file.h"
#include "tiles.h"

namespace kiln {
namespace {

namespace fs = std::filesystem;

std::string folder_name(const fs::path& folder) {
  const fs::path clean = folder.lexically_normal();
  const fs::path last = clean.has_filename() ? clean.filename() : clean.parent_path().filename();
  if (last.empty() || last == "." || last == "..") {
    std::error_code failure;
    return fs::weakly_canonical(folder, failure).filename().string();
  }
  return last.string();
}

PlannedMap planned(const MapSource& source, const fs::path& folder, SpecularEncoding encoding) {
  PlannedMap map;
  map.slot = source.slot;
  map.path = folder / source.file;
  map.channels = source.channels;
  map.if_present = source.if_present;
  map.convention = source.convention;
  map.encoding = encoding;
  map.reason = source.reason;
  return map;
}

std::string channels_of(const MapChoice& choice) {
  if (choice.decoding.angle == AngleEncoding::Direction) return "rg";
  return slot_facts(choice.slot).channels == 3 ? "rgb" : "r";
}

PlannedMap planned(const MapChoice& choice, SpecularEncoding encoding) {
  PlannedMap map;
  map.slot = choice.slot;
  map.path = choice.path;
  map.channels = choice.channel.empty() ? channels_of(choice) : choice.channel;
  map.convention = choice.convention;
  map.encoding = choice.encoding.value_or(encoding);
  map.decoding = choice.decoding;
  map.color_space = choice.color_space;
  map.value = choice.value;
  map.reason = "stated";
  return map;
}

NamingRules rules_of(const SetChoice& choice, const MaterialChoice& material) {
  return {choice.naming, choice.workflow ? choice.workflow : material.workflow};
}

std::vector<PlannedSet> sets_in(const fs::path& folder, const std::vector<std::string>& files,
                                const std::string& name, const SetChoice& choice,
                                const MaterialChoice& material) {
  std::vector<PlannedSet> sets;
  for (const FoundSet& found : find_sets(name, files, rules_of(choice, material))) {
    PlannedSet set;
    set.name = found.name;
    set.source = folder.string();
    set.reading = choice.reading;
    set.reading.workflow = found.workflow;
    set.workflow_reason = found.workflow_reason;
    for (const MapSource& source : found.maps) {
      set.maps.push_back(planned(source, folder, material.specular));
    }
    set.ignored = found.ignored;
    set.warnings = found.warnings;
    sets.push_back(std::move(set));
  }
  return sets;
}

PlannedSet set_of_maps(const SetChoice& choice, const MaterialChoice& material) {
  PlannedSet set;
  set.name = choice.name;
  set.source = choice.place.file;
  set.reading = choice.reading;
  std::vector<Slot> given;
  for (const MapChoice& map : choice.maps) {
    set.maps.push_back(planned(map, material.specular));
    given.push_back(map.slot);
  }
  const WorkflowGuess guess = guess_workflow(given);
  const std::optional<Workflow> stated = choice.workflow ? choice.workflow : material.workflow;
  set.reading.workflow = stated.value_or(guess.workflow);
  set.workflow_reason = stated ? "stated" : guess.reason;
  return set;
}

PlannedSet broken_set(const std::string& name, const fs::path& source, const Error& fault) {
  PlannedSet set;
  set.name = name;
  set.source = source.string();
  set.fault = fault;
  return set;
}

// Models light every set of a pipeline alike, so a file's own count only where it is alone.
PlannedSet set_of_material_file(const fs::path& path, const std::string& name) {
  PlannedSet set;
  const std::optional<Error> fault = error_leaving([&] {
    const MaterialFile file = read_material_file(path);
    set = set_of_maps(file.set, file.material);
    set.alpha_cutoff = file.set.alpha_cutoff;
    if (file.models.empty()) return;
    set.warnings.push_back(fmt::format("{}: {} not read here, models are those of the pipeline",
                                       path.string(), fmt::join(file.models, ", ")));
  });
  if (fault) return broken_set(name.empty() ? path.stem().string() : name, path, *fault);
  if (!name.empty()) set.name = name;
  return set;
}

void plan_globbed(const SetChoice& choice, const MaterialChoice& material, Plan& plan,
                  Mistakes& mistakes) {
  const std::vector<fs::path> folders = expand_folders(choice.glob);
  if (folders.empty()) {
    mistakes.add(choice.place, fmt::format("glob: no folder matches '{}'", choice.glob));
    return;
  }
  const size_t before = plan.sets.size();
  for (const fs::path& folder : folders) {
    std::vector<PlannedSet> sets =
        sets_in(folder, files_in(folder), folder_name(folder), choice, material);
    if (sets.empty()) {
      plan.warnings.push_back(
          fmt::format("{}: skipped, no file is named like a known map", folder.string()));
    }
    plan.sets.insert(plan.sets.end(), sets.begin(), sets.end());
  }
  if (plan.sets.size() == before) {
    mistakes.add(choice.place,
                 fmt::format("glob: none of the {} folders that match '{}' holds a known map",
                             folders.size(), choice.glob));
  }
}

void keep_chosen(const std::string& name, std::vector<PlannedSet>& sets) {
  if (name.empty()) return;
  std::vector<std::string> names;
  names.reserve(sets.size());
  for (const PlannedSet& set : sets) names.push_back(set.name);
  if (!std::count(names.begin(), names.end(), name)) {
    throw Error(Fault::Usage, unknown_name("set", name, names));
  }
  std::erase_if(sets, [&](const PlannedSet& set) { return set.name != name; });
}

// The materials of a document, under a stated name where there is one.
std::vector<PlannedSet> sets_of_document(const SetChoice& choice) {
  std::vector<PlannedSet> sets;
  const std::optional<Error> fault =
      error_leaving([&] { sets = document_sets(choice.path, choice.reading); });
  if (fault) {
    const std::string name = choice.name.empty() ? choice.path.stem().string() : choice.name;
    return {broken_set(name, choice.path, *fault)};
  }
  if (!choice.material.empty()) keep_chosen(choice.material, sets);
  for (PlannedSet& set : sets) {
    if (choice.workflow) set.reading.workflow = *choice.workflow;
    if (choice.name.empty()) continue;
    set.name = sets.size() == 1 ? choice.name : choice.name + "." + set.name;
  }
  return sets;
}

std::vector<PlannedSet> sets_of_folder(const SetChoice& choice, const MaterialChoice& material) {
  const fs::path& folder = choice.path;
  const std::string name = choice.name.empty() ? folder_name(folder) : choice.name;
  std::vector<PlannedSet> sets = sets_in(folder, files_in(folder), name, choice, material);
  if (!sets.empty()) return sets;
  const Error fault(Fault::Input,
                    fmt::format("{}: no file in it is named like a known map", folder.string()));
  return {broken_set(name, folder, fault)};
}

// An image that holds a set by itself: by its layout, else by the token that its name ends in.
std::vector<PlannedSet> sets_of_image(const SetChoice& choice, const MaterialChoice& material) {
  const fs::path& image = choice.path;
  const std::string name = choice.name.empty() ? image.stem().string() : choice.name;
  if (choice.packed.empty()) {
    const std::vector<std::string> file{image.filename().string()};
    std::vector<PlannedSet> sets = sets_in(image.parent_path(), file, name, choice, material);
    if (!sets.empty()) return sets;
    const Error fault(Fault::Input,
                      fmt::format("{}: its name is that of no map, expected a folder of maps, or "
                                  "the layout of this file as `packed`",
                                  image.string()));
    return {broken_set(name, image, fault)};
  }
  PlannedSet set = packed_set(image, choice.packed);
  if (!choice.name.empty()) set.name = choice.name;
  const std::optional<Workflow> stated = choice.workflow ? choice.workflow : material.workflow;
  const Workflow workflow = stated.value_or(set.reading.workflow);
  set.reading = choice.reading;
  set.reading.workflow = workflow;
  if (stated) set.workflow_reason = "stated";
  for (PlannedMap& map : set.maps) map.encoding = material.specular;
  return {set};
}

// What is named directly is wanted: if it is of no use, its tasks fail instead of vanishing.
std::vector<PlannedSet> sets_at_path(const SetChoice& choice, const MaterialChoice& material) {
  const fs::path& path = choice.path;
  std::error_code failure;
  const bool is_folder = fs::is_directory(path, failure);
  if (!choice.packed.empty() && (is_folder || is_material_document(path))) {
    throw Error(Fault::Usage,
                fmt::format("packed: {} is no image, but has maps of its own", path.string()));
  }
  if (is_material_document(path)) return sets_of_document(choice);
  if (is_material_file(path)) return {set_of_material_file(path, choice.name)};
  if (is_folder) return sets_of_folder(choice, material);
  if (fs::exists(path, failure)) return sets_of_image(choice, material);
  const Error fault(Fault::Input, fmt::format("{}: no such folder", path.string()));
  return {broken_set(choice.name.empty() ? folder_name(path) : choice.name, path, fault)};
}

void plan_globbed_files(const SetChoice& choice, const MaterialChoice& material, Plan& plan,
                        Mistakes& mistakes) {
  const std::vector<fs::path> files = expand_files(choice.glob);
  if (files.empty()) {
    mistakes.add(choice.place, fmt::format("glob: no file matches '{}'", choice.glob));
  }
  for (const fs::path& file : files) {
    SetChoice one = choice;
    one.path = file;
    std::vector<PlannedSet> sets = sets_at_path(one, material);
    std::move(sets.begin(), sets.end(), std::back_inserter(plan.sets));
  }
}

void refuse_equal_names(const Plan& plan, Mistakes& mistakes) {
  std::map<std::string, std::string> seen;
  for (const PlannedSet& set : plan.sets) {
    const auto [first, fresh] = seen.emplace(set.name, set.source);
    if (fresh) continue;
    mistakes.add({}, fmt::format("two texture sets are named '{}': {} and {}", set.name,
                                 first->second, set.source));
  }
}

}  // namespace

void plan_sets(const Pipeline& pipeline, Plan& plan, Mistakes& mistakes) {
  for (const SetChoice& choice : pipeline.sets) {
    Plan own;
    if (is_material_file(choice.glob) || is_material_document(choice.glob)) {
      plan_globbed_files(choice, pipeline.material, own, mistakes);
    } else if (!choice.glob.empty()) {
      plan_globbed(choice, pipeline.material, own, mistakes);
    } else if (!choice.path.empty()) {
      attempt(mistakes, choice.place, [&] { own.sets = sets_at_path(choice, pipeline.material); });
    } else {
      own.sets.push_back(set_of_maps(choice, pipeline.material));
    }
    for (PlannedSet& set : own.sets) {
      if (choice.alpha_cutoff) set.alpha_cutoff = choice.alpha_cutoff;
    }
    own.sets = tile_by_tile(std::move(own.sets));
    attempt(mistakes, choice.place, [&] { keep_chosen(choice.chosen, own.sets); });
    std::move(own.sets.begin(), own.sets.end(), std::back_inserter(plan.sets));
    plan.warnings.insert(plan.warnings.end(), own.warnings.begin(), own.warnings.end());
  }
  refuse_equal_names(plan, mistakes);
}

}  // namespace kiln

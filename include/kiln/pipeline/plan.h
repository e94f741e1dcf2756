// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "kiln/bake/bake.h"
#include "kiln/core/error.h"
#include "kiln/io/image_bytes.h"
#include "kiln/material/naming.h"
#include "kiln/pipeline/pipeline.h"

namespace kiln {

/// One slot of a set: a file or a constant, and why.
struct PlannedMap {
  Slot slot = Slot::BaseColor;
  std::filesystem::path path;  ///< empty: a constant
  ImageBytes embedded = {};    ///< the image itself, where it lies inside another file
  std::string channels;        ///< "rgb", "r", ...
  bool if_present = false;     ///< left out where the file has no such channel
  NormalConvention convention = NormalConvention::Auto;
  SpecularEncoding encoding = SpecularEncoding::Level;
  SlotDecoding decoding = {};  ///< of colours, scale and offset count in their own linear space
  std::string color_space;     ///< as stated; empty: by the file's type
  std::optional<std::array<float, 3>> value;
  std::string reason;
};

struct PlannedSet {
  std::string name;  ///< of a UDIM tile: NAME.1001
  std::optional<int> tile;
  std::string source;  ///< the folder, or where the set is written
  WorkflowSettings reading;
  std::string workflow_reason;
  std::vector<PlannedMap> maps;
  std::optional<double> alpha_cutoff;  ///< of a cutout
  std::vector<IgnoredFile> ignored;
  std::vector<std::string> warnings;
  std::optional<Error> fault;  ///< why none of its tasks can run
};

struct Task {
  std::string bake;
  std::shared_ptr<const Recipe> recipe;
  Needs needs;
  Product product = Product::Numbers;
  std::optional<size_t> set;          ///< index into Plan::sets
  std::optional<size_t> environment;  ///< index into Plan::environments
  std::string out;                    ///< below the output folder, with '/'
  OutputChoice output;
};

/// Everything that a run will do, decided before it does anything.
struct Plan {
  std::filesystem::path file;  ///< of the pipeline, or empty
  std::string name;
  std::filesystem::path output;  ///< folder
  ColorChoice color;             ///< with the config chosen
  MaterialChoice material;
  std::vector<EnvironmentChoice> environments;
  std::vector<PlannedSet> sets;
  std::vector<Task> tasks;  ///< those of no set first, then set by set
  std::vector<std::string> warnings;
  long long max_memory = 0;  ///< [byte] that the process may take; 0: no limit
};

/// What a task takes at most, by the headers of its files: an upper bound [byte]. Nothing where it
/// is not predicted: tables and environments, and sets whose files cannot be read.
std::optional<long long> predicted_memory(const Plan& plan, const Task& task);

/// The texture sets of a pipeline, with what fills their slots.
/// @error as make_plan
std::vector<PlannedSet> planned_sets(const Pipeline& pipeline);

/// Finds the sets, makes the recipes and names the outputs.
/// @error Fault::Usage with every mistake found: unknown words, patterns that match nothing,
/// outputs
///        that collide or leave the output folder; Fault::Input for an unreadable colour config
Plan make_plan(const Pipeline& pipeline, const std::filesystem::path& output);

/// The tasks whose set or output one of the patterns matches (all, if there are none).
/// @error Fault::Usage for a pattern that matches nothing
Plan only(Plan plan, const std::vector<std::string>& patterns);

/// Where the outputs of a pipeline file go unless told: `out` beside the file.
std::filesystem::path default_output(const std::filesystem::path& pipeline_file);

}  // namespace kiln

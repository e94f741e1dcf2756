// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "kiln/core/error.h"
#include "kiln/pipeline/plan.h"

namespace kiln {

/// "kiln 0.1.0"
std::string software();

/// What became of one slot of a set.
struct MapRecord {
  std::string slot;
  std::string source;  ///< file, or "constant"
  std::string channels;
  std::string reason;
  std::string color;  ///< "data", or "srgb_rec709_scene -> lin_rec709_scene"
};

struct SetRecord {
  std::string name;
  std::string workflow;
  std::vector<MapRecord> maps;
  std::vector<std::string> notes;
  std::vector<std::string> warnings;
};

struct EnvironmentRecord {
  std::string name;
  std::string source;
  std::string color;
  std::vector<std::string> notes;
  std::vector<std::string> warnings;  ///< texels that were repaired, or are odd
};

struct TaskRecord {
  enum class Status { NotRun, Baked, Failed };
  Status status = Status::NotRun;
  std::string bake;
  std::string set;  ///< empty: of no set
  std::string out;
  std::vector<std::string> outputs;  ///< below the output folder
  std::vector<std::string> notes;
  std::vector<std::pair<std::string, double>> figures;
  std::optional<Error> fault;
  double seconds = 0;
};

/// What a run did. Everything but the seconds is the same for every run on the same inputs.
struct Report {
  std::string pipeline;  ///< name, or the file's
  std::vector<std::string> warnings;
  std::vector<SetRecord> sets;  ///< those that were loaded
  std::vector<EnvironmentRecord> environments;
  std::vector<TaskRecord> tasks;
  int signal = 0;  ///< that ended the run early, or 0
  double seconds = 0;
};

int count(const Report& report, TaskRecord::Status status);

/// 128 + signal; 33 if no task fits into memory, 1 if a task failed, else 0.
int exit_code(const Report& report);

/// The report without times: byte for byte the same for the same inputs.
std::string report_json(const Report& report);
std::string times_json(const Report& report);

/// A table of sets: tasks, baked, failed, seconds.
std::string summary_table(const Report& report);

/// Arguments of `kiln run` that choose the tasks which did not succeed; empty if there are none.
std::vector<std::string> retry_patterns(const Report& report);

/// Tasks with their outputs and the reason why each would run.
std::string dry_run_table(const Plan& plan);
std::string dry_run_json(const Plan& plan);

}  // namespace kiln

// SPDX-License-Identifier: Apache-2.0
#include "kiln/pipeline/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

namespace kiln {
namespace {

using Json = nlohmann::ordered_json;
using Status = TaskRecord::Status;

std::string status_name(Status status) {
  switch (status) {
    case Status::NotRun:
      return "not run";
    case Status::Baked:
      return "baked";
    case Status::Failed:
      return "failed";
  }
  return "not run";
}

Json to_json(const MapRecord& map) {
  return {{"slot", map.slot},
          {"source", map.source},
          {"channels", map.channels},
          {"reason", map.reason},
          {"color", map.color}};
}

Json to_json(const SetRecord& set) {
  Json maps = Json::array();
  for (const MapRecord& map : set.maps) maps.push_back(to_json(map));
  return {{"name", set.name},
          {"workflow", set.workflow},
          {"maps", maps},
          {"notes", set.notes},
          {"warnings", set.warnings}};
}

Json to_json(const EnvironmentRecord& environment) {
  return {{"name", environment.name},
          {"source", environment.source},
          {"color", environment.color},
          {"notes", environment.notes},
          {"warnings", environment.warnings}};
}

Json to_json(const TaskRecord& task) {
  Json figures = Json::object();
  for (const auto& [name, value] : task.figures) figures[name] = value;
  Json json = {{"bake", task.bake},       {"set", task.set},
               {"out", task.out},         {"status", status_name(task.status)},
               {"outputs", task.outputs}, {"notes", task.notes},
               {"figures", figures}};
  if (task.fault) {
    json["fault"] = {{"code", exit_code(task.fault->fault())}, {"message", task.fault->what()}};
  }
  return json;
}

template <class Record>
Json list_of(const std::vector<Record>& records) {
  Json list = Json::array();
  for (const Record& record : records) list.push_back(to_json(record));
  return list;
}

// Text of any file name: bytes that are no UTF-8 are replaced, not refused.
std::string dumped(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

struct Row {
  std::string set;
  int tasks = 0, baked = 0, failed = 0;
  double seconds = 0;
};

void add(Row& row, const TaskRecord& task) {
  ++row.tasks;
  row.baked += task.status == Status::Baked;
  row.failed += task.status == Status::Failed;
  row.seconds += task.seconds;
}

std::vector<Row> rows_of(const Report& report) {
  std::vector<Row> rows;
  std::map<std::string, size_t> place;
  Row total{"all"};
  for (const TaskRecord& task : report.tasks) {
    const auto [found, fresh] = place.emplace(task.set, rows.size());
    if (fresh) rows.push_back({task.set.empty() ? "(no set)" : task.set});
    add(rows[found->second], task);
    add(total, task);
  }
  if (rows.size() > 1) rows.push_back(total);
  return rows;
}

std::string set_of(const Plan& plan, const Task& task) {
  return task.set ? plan.sets[*task.set].name : "(no set)";
}

}  // namespace

std::string software() { return std::string("kiln ") + KILN_VERSION; }

int count(const Report& report, Status status) {
  return static_cast<int>(std::count_if(report.tasks.begin(), report.tasks.end(),
                                        [&](const TaskRecord& t) { return t.status == status; }));
}

int exit_code(const Report& report) {
  if (report.signal != 0) return 128 + report.signal;
  const bool none_fits =
      !report.tasks.empty() &&
      std::all_of(report.tasks.begin(), report.tasks.end(), [](const TaskRecord& task) {
        return task.fault && task.fault->fault() == Fault::Memory;
      });
  if (none_fits) return exit_code(Fault::Memory);
  return count(report, Status::Failed) > 0 ? 1 : 0;
}

std::string report_json(const Report& report) {
  return dumped({{"software", software()},
                 {"pipeline", report.pipeline},
                 {"counts",
                  {{"tasks", report.tasks.size()},
                   {"baked", count(report, Status::Baked)},
                   {"failed", count(report, Status::Failed)}}},
                 {"warnings", report.warnings},
                 {"environments", list_of(report.environments)},
                 {"sets", list_of(report.sets)},
                 {"tasks", list_of(report.tasks)}});
}

std::string times_json(const Report& report) {
  Json tasks = Json::array();
  for (const TaskRecord& task : report.tasks) {
    tasks.push_back({{"out", task.out}, {"seconds", task.seconds}});
  }
  return dumped({{"seconds", report.seconds}, {"tasks", tasks}});
}

std::string summary_table(const Report& report) {
  const std::vector<Row> rows = rows_of(report);
  size_t width = 3;
  for (const Row& row : rows) width = std::max(width, row.set.size());
  std::string text = fmt::format("{:<{}}  {:>5}  {:>5}  {:>6}  {:>8}\n", "set", width, "tasks",
                                 "baked", "failed", "seconds");
  for (const Row& row : rows) {
    text += fmt::format("{:<{}}  {:>5}  {:>5}  {:>6}  {:>8.2f}\n", row.set, width, row.tasks,
                        row.baked, row.failed, row.seconds);
  }
  return text;
}

// A set of which nothing succeeded is named once; otherwise its outputs are.
std::vector<std::string> retry_patterns(const Report& report) {
  std::set<std::string> touched;
  for (const TaskRecord& task : report.tasks) {
    if (task.status == Status::Baked) touched.insert(task.set);
  }
  std::vector<std::string> patterns;
  for (const TaskRecord& task : report.tasks) {
    if (task.status == Status::Baked) continue;
    const bool whole = !task.set.empty() && !touched.count(task.set);
    const std::string& pattern = whole ? task.set : task.out;
    if (patterns.empty() || patterns.back() != pattern) patterns.push_back(pattern);
  }
  return patterns;
}

namespace {

Json memory_json(std::optional<long long> bytes) { return bytes ? Json(*bytes) : Json(nullptr); }

}  // namespace

std::string dry_run_table(const Plan& plan) {
  size_t set_width = 0, bake_width = 0;
  for (const Task& task : plan.tasks) {
    set_width = std::max(set_width, set_of(plan, task).size());
    bake_width = std::max(bake_width, task.bake.size());
  }
  std::string text;
  for (const Task& task : plan.tasks) {
    const auto bytes = predicted_memory(plan, task);
    const std::string memory = bytes ? fmt::format("{} MiB", (*bytes >> 20) + 1) : "-";
    text +=
        fmt::format("{:<{}}  {:<{}}  new  {:>9}  {}{}\n", set_of(plan, task), set_width, task.bake,
                    bake_width, memory, task.out, task.product == Product::Folder ? "/" : "");
  }
  return text + fmt::format("{} tasks, {} texture sets\n", plan.tasks.size(), plan.sets.size());
}

std::string dry_run_json(const Plan& plan) {
  Json tasks = Json::array();
  for (const Task& task : plan.tasks) {
    tasks.push_back({{"bake", task.bake},
                     {"set", task.set ? plan.sets[*task.set].name : ""},
                     {"out", task.out},
                     {"reason", "new"},
                     {"memory_bytes", memory_json(predicted_memory(plan, task))}});
  }
  return dumped({{"software", software()}, {"tasks", tasks}, {"warnings", plan.warnings}});
}

}  // namespace kiln

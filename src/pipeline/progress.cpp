// SPDX-License-Identifier: Apache-2.0
#include "kiln/pipeline/progress.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace kiln {
namespace {

std::string title(const TaskRecord& record) {
  return record.set.empty() ? record.bake : record.set + ": " + record.bake;
}

}  // namespace

std::string progress_line(const TaskRecord& record, const Progress& progress) {
  const std::string begin =
      fmt::format("[{}/{}] {} -> {}", progress.done, progress.total, title(record), record.out);
  if (record.fault) return fmt::format("{}: failed: {}", begin, record.fault->what());
  return fmt::format("{}, {:.2f} s", begin, record.seconds);
}

std::string progress_json(const TaskRecord& record, const Progress& progress) {
  nlohmann::ordered_json json = {{"done", progress.done},
                                 {"total", progress.total},
                                 {"set", record.set},
                                 {"bake", record.bake},
                                 {"out", record.out},
                                 {"seconds", record.seconds},
                                 {"failed", record.fault.has_value()}};
  if (record.fault) {
    json["code"] = exit_code(record.fault->fault());
    json["message"] = record.fault->what();
  }
  return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

std::string progress_bar(const TaskRecord& record, const Progress& progress, int columns) {
  constexpr int width = 24;
  const int full = progress.total > 0 ? width * progress.done / progress.total : width;
  const std::string bar = std::string(static_cast<size_t>(full), '#') +
                          std::string(static_cast<size_t>(width - full), '-');
  std::string line =
      fmt::format("{}  {}/{}  {}", bar, progress.done, progress.total, title(record));
  if (static_cast<int>(line.size()) > columns) line.resize(static_cast<size_t>(columns));
  return line;
}

}  // namespace kiln

// SPDX-License-Identifier: Apache-2.0
#include "kiln/pipeline/report.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "kiln/pipeline/progress.h"

namespace kiln {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TaskRecord task(const std::string& set, const std::string& out, TaskRecord::Status status) {
  TaskRecord record;
  record.bake = "preview";
  record.set = set;
  record.out = out;
  record.status = status;
  record.seconds = 1;
  if (status == TaskRecord::Status::Failed) record.fault = Error(Fault::Input, "broken");
  return record;
}

Report mixed_report() {
  using enum TaskRecord::Status;
  Report report;
  report.tasks = {task("", "lut.exr", Baked), task("a", "a/1.exr", Baked),
                  task("a", "a/2.exr", Failed), task("b", "b/1.exr", Failed),
                  task("b", "b/2.exr", Failed)};
  return report;
}

TEST(Report, CountsWhatFailed) {
  EXPECT_EQ(count(mixed_report(), TaskRecord::Status::Failed), 3);
  EXPECT_EQ(exit_code(mixed_report()), 1);
  EXPECT_EQ(exit_code(Report{}), 0);
}

TEST(Report, EndsWithTheSignalThatEndedTheRun) {
  Report report;
  report.signal = 2;
  EXPECT_EQ(exit_code(report), 130);
}

TEST(Report, RetriesWholeSetsByNameAndSingleTasksByOutput) {
  EXPECT_THAT(retry_patterns(mixed_report()), ElementsAre("a/2.exr", "b"));
}

TEST(Report, KeepsTimesOutOfTheRecord) {
  Report slow = mixed_report();
  slow.tasks[0].seconds = 99;
  slow.seconds = 1000;
  EXPECT_EQ(report_json(slow), report_json(mixed_report()));
  EXPECT_NE(times_json(slow), times_json(mixed_report()));
}

TEST(Report, TellsTheFaultOfATask) {
  const auto json = nlohmann::json::parse(report_json(mixed_report()));
  EXPECT_EQ(json["tasks"][2]["status"], "failed");
  EXPECT_EQ(json["tasks"][2]["fault"]["code"], 3);
  EXPECT_EQ(json["tasks"][2]["fault"]["message"], "broken");
}

TEST(Report, SurvivesFileNamesThatAreNoUtf8) {
  Report report;
  report.tasks = {task("a\xff", "a\xff/1.exr", TaskRecord::Status::Baked)};
  EXPECT_TRUE(nlohmann::json::accept(report_json(report)));
}

TEST(SummaryTable, HasALineForEverySetAndTheSum) {
  const std::string table = summary_table(mixed_report());
  EXPECT_THAT(table, HasSubstr("(no set)      1      1       0"));
  EXPECT_THAT(table, HasSubstr("b             2      0       2"));
  EXPECT_THAT(table, HasSubstr("all           5      2       3"));
}

TEST(ProgressBar, NeverExceedsTheTerminal) {
  const TaskRecord record = task("a long name of a set", "x", TaskRecord::Status::NotRun);
  EXPECT_LE(progress_bar(record, {1, 3}, 40).size(), 40u);
}

TEST(ProgressLine, SaysWhatWentWrong) {
  EXPECT_EQ(progress_line(task("a", "a/2.exr", TaskRecord::Status::Failed), {2, 5}),
            "[2/5] a: preview -> a/2.exr: failed: broken");
}

}  // namespace
}  // namespace kiln

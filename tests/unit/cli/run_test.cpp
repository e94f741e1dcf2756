// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <csignal>
#include <limits>
#include <nlohmann/json.hpp>
#include <thread>

#include "kiln/image/layers.h"
#include "support/command.h"

namespace kiln {
namespace {

using test::Command;
using test::kiln;
using test::Outcome;
using test::Workshop;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

class RunVerb : public testing::Test {
 protected:
  Outcome run(const std::string& pipeline, std::vector<std::string> more = {}) const {
    const auto file = shop_.write("rocks.yaml", "version: 1\n" + pipeline);
    std::vector<std::string> words = {"run", file.string(), "-o", (shop_ / "out").string()};
    words.insert(words.end(), more.begin(), more.end());
    return kiln(shop_, words);
  }
  bool exists(const std::string& name) const { return std::filesystem::exists(shop_ / name); }

  const Workshop shop_;
};

const char* const two_tables =
    "bakes:\n  - { bake: lut, size: 4, out: a.exr }\n  - { bake: lut, size: 8, out: b.exr }\n";

TEST_F(RunVerb, BakesAndPrintsATable) {
  const Outcome outcome = run(two_tables);
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("set       tasks  baked  failed   seconds"));
  EXPECT_THAT(outcome.err, HasSubstr("[2/2] lut -> b.exr"));
  EXPECT_TRUE(exists("out/a.exr"));
  EXPECT_TRUE(exists("out/.kiln/report.json"));
}

TEST_F(RunVerb, PutsOutputsBesideTheFileUnlessTold) {
  const auto file = shop_.write("p/rocks.yaml", std::string("version: 1\n") + two_tables);
  EXPECT_EQ(kiln(shop_, {"run", file.string(), "-q"}).code, 0);
  EXPECT_TRUE(exists("p/out/a.exr"));
}

TEST_F(RunVerb, PrintsTheReportAsJson) {
  const Outcome outcome = run(two_tables, {"--json", "--progress", "json"});
  EXPECT_EQ(nlohmann::json::parse(outcome.out)["counts"]["baked"], 2);
  const std::string first = outcome.err.substr(0, outcome.err.find('\n'));
  EXPECT_EQ(nlohmann::json::parse(first)["done"], 1);
}

TEST_F(RunVerb, ShowsWhatItWouldDoWithoutDoingIt) {
  const Outcome outcome = run(two_tables, {"--dry-run"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.out, ContainsRegex("\\(no set\\)  lut  new +-  a.exr"));
  EXPECT_FALSE(exists("out"));
}

TEST_F(RunVerb, RunsOnlyWhatMatches) {
  EXPECT_EQ(run(two_tables, {"--only", "b*"}).code, 0);
  EXPECT_FALSE(exists("out/a.exr"));
  EXPECT_TRUE(exists("out/b.exr"));
}

TEST_F(RunVerb, SetsVariables) {
  const std::string pipeline =
      "vars: { n: a }\nbakes: [{ bake: lut, size: 4, out: \"{n}.exr\" }]\n";
  EXPECT_EQ(run(pipeline, {"--set", "n=z"}).code, 0);
  EXPECT_TRUE(exists("out/z.exr"));
  EXPECT_THAT(run(pipeline, {"--set", "m=z"}).err, HasSubstr("unknown variable 'm'"));
}

TEST_F(RunVerb, RefusesAPlanBeforeAnythingRuns) {
  const std::vector<std::pair<std::string, std::string>> bad = {
      {"bakes: [{ bake: lut, siz: 4, out: a.exr }]", "unknown key 'siz' (did you mean 'size'?)"},
      {"bakes: [{ bake: lut, size: 4, size: 8, out: a.exr }]", "duplicate key 'size'"},
      {"bakes: [{ bake: lit, out: a.exr }]", "unknown bake 'lit' (did you mean 'lut'?)"},
      {"bakes: [{ bake: lut, table: split, out: a.exr }]", "unknown table 'split'"},
      {"material: { distribution: gxg }\nbakes: []", "unknown distribution 'gxg'"},
      {"color: { working: linear }\nbakes: []", "linear"},
      {"bakes: [{ bake: lut, out: ../a.exr }]", "leaves the output folder"},
      {"bakes: [{ bake: lut, out: a.exr }, { bake: lut, out: a.exr }]", "one output"},
      {"bakes: [{ bake: lut, out: \"{sett}.exr\" }]", "unknown variable 'sett'"},
      {"validate: { profile: unity }\nbakes: []", "unknown key 'validate'"}};
  for (const auto& [pipeline, message] : bad) {
    const Outcome outcome = run(pipeline);
    EXPECT_EQ(outcome.code, 2) << pipeline;
    EXPECT_THAT(outcome.err, HasSubstr(message)) << pipeline;
    EXPECT_FALSE(exists("out")) << pipeline;
  }
}

TEST_F(RunVerb, TellsTheFileLineAndColumn) {
  EXPECT_THAT(run("bakes:\n  - { bake: lut, siz: 4, out: a.exr }\n").err,
              HasSubstr("rocks.yaml:3:18: unknown key 'siz'"));
}

TEST_F(RunVerb, OfAMissingFileIsAnInputError) {
  EXPECT_EQ(kiln(shop_, {"run", (shop_ / "no.yaml").string()}).code, 3);
}

TEST_F(RunVerb, EndsWithFiveWhenTheOutputRootCannotBeWritten) {
  const auto file = shop_.write("rocks.yaml", std::string("version: 1\n") + two_tables);
  const Outcome outcome = kiln(shop_, {"run", file.string(), "-o", (file / "out").string()});
  EXPECT_EQ(outcome.code, 5) << outcome.err;
}

TEST_F(RunVerb, FinishesTheOtherTasksAndPrintsHowToRetry) {
  shop_.paint("sky.exr", 1.0f, PixelType::Float, {16, 8});
  shop_.paint_set("tex/good", ".exr");
  shop_.paint_set("tex/zero", ".exr");
  shop_.write("tex/zero/zero_Roughness.exr", "");
  shop_.write("tex/notes/readme.txt", "x");
  const Outcome outcome = run(R"(
environment: { sky: sky.exr }
sets: [{ glob: "tex/*/" }, { path: missing }]
bakes: [{ bake: preview, env: sky, samples: 4, out: "{set}/flat.exr" }]
)");
  EXPECT_EQ(outcome.code, 1) << outcome.err;
  EXPECT_TRUE(exists("out/good/flat.exr"));
  EXPECT_FALSE(exists("out/zero"));
  EXPECT_THAT(outcome.err, HasSubstr("warning: "));
  EXPECT_THAT(outcome.err, HasSubstr("zero_Roughness.exr"));
  EXPECT_THAT(outcome.err, HasSubstr("missing: no such folder"));
  EXPECT_THAT(outcome.err, HasSubstr("to retry: kiln run "));
  EXPECT_THAT(outcome.err, HasSubstr("--only zero --only missing"));
}

TEST_F(RunVerb, StopsAtASignalAndLeavesNoPartialFile) {
  std::string pipeline = "version: 1\nbakes:\n";
  for (int i = 0; i < 400; ++i) {
    pipeline += "  - { bake: lut, size: 48, out: " + std::to_string(i) + ".exr }\n";
  }
  const auto file = shop_.write("many.yaml", pipeline);
  const Command command(shop_, {"run", file.string(), "-o", (shop_ / "out").string()});
  while (!exists("out/0.exr")) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  command.send(SIGTERM);
  const Outcome outcome = command.wait();
  EXPECT_EQ(outcome.code, 143) << outcome.err;
  EXPECT_FALSE(exists("out/399.exr"));
  for (const auto& entry : std::filesystem::directory_iterator(shop_ / "out")) {
    const std::string name = entry.path().filename().string();
    if (name == ".kiln") continue;
    EXPECT_NO_THROW(read_image(entry.path())) << name;
    EXPECT_TRUE(std::isdigit(static_cast<unsigned char>(name[0]))) << name;
  }
}

}  // namespace
}  // namespace kiln

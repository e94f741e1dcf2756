// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <algorithm>
#include <sstream>

#include "support/command.h"

namespace kiln {
namespace {

using test::kiln;
using test::Outcome;
using test::Workshop;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

const std::vector<std::string> verbs = {"run",     "lut",     "verify", "env",
                                        "preview", "inspect", "diff",   "list"};

void expect_refused(const std::vector<std::string>& arguments, const std::string& message,
                    int code = 2) {
  const Workshop shop;
  const Outcome outcome = kiln(shop, arguments);
  EXPECT_EQ(outcome.code, code) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("kiln: error: "));
  EXPECT_THAT(outcome.err, HasSubstr(message));
  EXPECT_THAT(outcome.out, IsEmpty());
}

TEST(Help, ListsTheVerbsThatThereAreAndNoOther) {
  const Workshop shop;
  const Outcome help = kiln(shop, {"--help"});
  EXPECT_EQ(help.code, 0);
  for (const std::string& verb : verbs) EXPECT_THAT(help.out, HasSubstr("  kiln " + verb + " "));
  for (const char* absent : {"validate", "farm", "merge"}) {
    EXPECT_THAT(help.out, Not(HasSubstr(absent)));
  }
}

TEST(Help, OfEveryVerbFitsAScreen) {
  const Workshop shop;
  for (const std::string& verb : verbs) {
    const Outcome help = kiln(shop, {verb, "--help"});
    EXPECT_EQ(help.code, 0) << verb;
    EXPECT_LE(std::count(help.out.begin(), help.out.end(), '\n'), 40) << verb;
    std::istringstream lines(help.out);
    for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 100u) << line;
  }
}

TEST(Help, GoesToStderrWhereNothingWasAsked) {
  const Workshop shop;
  const Outcome outcome = kiln(shop, {});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("kiln run PIPELINE"));
}

TEST(Version, IsPrinted) {
  const Workshop shop;
  const Outcome outcome = kiln(shop, {"--version"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.out, StartsWith("kiln "));
}

TEST(CommandLine, NamesTheNearestVerbAndOption) {
  expect_refused({"lutt", "split-sum"}, "unknown verb 'lutt' (did you mean 'lut'?)");
  expect_refused({"lut", "split-sum", "--sise", "8", "-o", "a.exr"},
                 "unknown option '--sise' (did you mean '--size'?)");
  expect_refused({"run", "a.yaml", "--ony=x"}, "unknown option '--ony' (did you mean '--only'?)");
  expect_refused({"--json", "lut"}, "expected a verb first, found '--json'");
}

TEST(CommandLine, RefusesVerbsThatAreNotBuilt) {
  expect_refused({"validate", "x"}, "unknown verb 'validate'");
  expect_refused({"farm", "x"}, "unknown verb 'farm'");
}

TEST(CommandLine, NamesTheNearestWord) {
  expect_refused({"lut", "split-sun", "-o", "a.exr"}, "(did you mean 'split-sum'?)");
  expect_refused({"lut", "split-sum", "--distribution", "gxx", "-o", "a.exr"},
                 "unknown distribution 'gxx'");
  expect_refused({"run", "a.yaml", "--progress", "plane"}, "(did you mean 'plain'?)");
  expect_refused({"list", "bakse"}, "unknown kind or name 'bakse' (did you mean 'bakes'?)");
}

TEST(CommandLine, ChecksTheOptionsOfEveryVerb) {
  expect_refused({"list", "--isa", "avx512"}, "this build holds avx2");
  expect_refused({"list", "-j", "0"}, "--threads: found '0'");
  expect_refused({"list", "--color", "blue"}, "unknown --color 'blue'");
  expect_refused({"list", "bakes", "models"}, "unexpected argument 'models'");
}

TEST(CommandLine, AcceptsEitherSpellingOfAnOption) {
  const Workshop shop;
  const Outcome outcome = kiln(shop, {"diff", "a", "b", "--max_error", "x"});
  EXPECT_THAT(outcome.err, HasSubstr("--max-error: found 'x'"));
}

TEST(CommandLine, SaysWhenAnOutputOrEnvironmentIsMissing) {
  expect_refused({"lut", "split-sum"}, "no output is given");
  expect_refused({"env", "sky.exr"}, "no output is given");
  expect_refused({"preview", "rocks", "-o", "a.exr"}, "no environment is given");
  expect_refused({"run"}, "expected a PIPELINE");
}

}  // namespace
}  // namespace kiln

// SPDX-License-Identifier: Apache-2.0
#include "kiln/pipeline/document.h"

#include <gmock/gmock.h>

#include <sstream>

#include "support/workshop.h"

namespace kiln {
namespace {

using test::error_of;
using test::message_of;
using testing::HasSubstr;
using testing::StartsWith;

TEST(Document, KeepsScalarsAsTheyWereWritten) {
  const Node root = parse_document("a: no\nb: 0x10\nc: 1e3\nd: \"null\"\n", "x.yaml");
  EXPECT_EQ(root.find("a")->text, "no");
  EXPECT_EQ(root.find("b")->text, "0x10");
  EXPECT_EQ(root.find("c")->text, "1e3");
  EXPECT_EQ(root.find("d")->text, "null");
}

TEST(Document, CountsLinesAndColumnsFromOne) {
  const Node root = parse_document("a: 1\nb:\n  - { c: 2 }\n", "x.yaml");
  const Node& c = *root.find("b")->items.at(0).find("c");
  EXPECT_EQ(shown(c.place), "x.yaml:3:10: ");
  EXPECT_EQ(shown(root.entries.at(1).place), "x.yaml:2:1: ");
}

TEST(Document, ReadsJsonAsYaml) {
  const Node root = parse_document("{\n\t\"a\":1,\"b\":[\"x\\/y\",true]\n}\n", "x.json");
  EXPECT_EQ(root.find("a")->text, "1");
  EXPECT_EQ(root.find("b")->items.at(0).text, "x/y");
  EXPECT_EQ(root.find("b")->items.at(1).text, "true");
}

TEST(Document, KeepsDuplicateKeysForTheCheckToFind) {
  EXPECT_EQ(parse_document("a: 1\na: 2\n", "x.yaml").entries.size(), 2u);
}

TEST(Document, FindsKeysInEitherSpelling) {
  const Node root = parse_document("base-color: x\n", "x.yaml");
  EXPECT_NE(root.find("base_color"), nullptr);
}

TEST(Document, TellsWhereTextIsMalformed) {
  const Error error = error_of([] { parse_document("a: [1, 2\nb: 3\n", "x.yaml"); });
  EXPECT_EQ(error.fault(), Fault::Usage);
  EXPECT_THAT(error.what(), StartsWith("x.yaml:2:2: "));
}

TEST(Document, RefusesASecondDocument) {
  EXPECT_THAT(message_of([] { parse_document("a: 1\n---\nb: 2\n", "x.yaml"); }),
              StartsWith("x.yaml:3:1: "));
}

TEST(Document, RefusesEndlessAliases) {
  std::ostringstream text;
  text << "a0: &a0 [x, x, x, x, x, x, x, x, x, x]\n";
  for (int i = 1; i < 9; ++i) {
    text << "a" << i << ": &a" << i << " [x";
    for (int j = 0; j < 10; ++j) text << ", *a" << i - 1;
    text << "]\n";
  }
  EXPECT_THAT(message_of([&] { parse_document(text.str(), "x.yaml"); }), HasSubstr("endless"));
  EXPECT_THAT(message_of([] { parse_document("a: &a [*a]\n", "x.yaml"); }), HasSubstr("x.yaml:1"));
}

TEST(Document, OfAMissingFileIsAnInputError) {
  const Error error = error_of([] { read_document("/nowhere/at/all.yaml"); });
  EXPECT_EQ(error.fault(), Fault::Input);
  EXPECT_THAT(error.what(), HasSubstr("/nowhere/at/all.yaml: no such file"));
}

TEST(Document, OfAFolderIsAnInputError) {
  const test::Workshop shop;
  EXPECT_EQ(error_of([&] { read_document(shop.folder()); }).fault(), Fault::Input);
}

TEST(Mistakes, AreReportedTogetherInTheFilesOrder) {
  Mistakes mistakes;
  mistakes.add({"x.yaml", 9, 1}, "second");
  mistakes.add({"x.yaml", 2, 5}, "first");
  EXPECT_EQ(message_of([&] { mistakes.raise(); }), "x.yaml:2:5: first\nx.yaml:9:1: second");
}

}  // namespace
}  // namespace kiln

// SPDX-License-Identifier: Apache-2.0
#include "kiln/store/publish.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdlib.h>
#include <sys/resource.h>

#include <csignal>
#include <fstream>
#include <iterator>
#include <set>
#include <stdexcept>
#include <thread>

#include "kiln/core/error.h"
#include "support/temporary_folder.h"

namespace kiln {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class Publishing : public testing::Test {
 protected:
  static std::string contents(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  std::set<std::string> names() const {
    std::set<std::string> result;
    for (const auto& entry : fs::directory_iterator(folder_)) {
      result.insert(entry.path().filename().string());
    }
    return result;
  }
  template <class Work>
  static std::string output_fault(Work&& work) {
    try {
      work();
    } catch (const Error& error) {
      EXPECT_EQ(error.fault(), Fault::Output) << error.what();
      return error.what();
    }
    ADD_FAILURE() << "nothing was refused";
    return "";
  }

  const test::TemporaryFolder own_;
  const fs::path folder_ = own_.folder();
};

TEST_F(Publishing, PutsTheWholeFileInPlace) {
  publish_text(folder_ / "a.txt", std::string("one\0two", 7));
  EXPECT_EQ(contents(folder_ / "a.txt"), std::string("one\0two", 7));
  EXPECT_EQ(names(), std::set<std::string>{"a.txt"});
}

TEST_F(Publishing, ReplacesWhatWasThere) {
  publish_text(folder_ / "a.txt", "a longer first text");
  publish_text(folder_ / "a.txt", "second");
  EXPECT_EQ(contents(folder_ / "a.txt"), "second");
}

TEST_F(Publishing, MakesMissingFolders) {
  publish_text(folder_ / "b" / "c" / "a.txt", "x");
  EXPECT_EQ(contents(folder_ / "b" / "c" / "a.txt"), "x");
}

TEST_F(Publishing, HidesTheTemporaryBesideTheFileAndKeepsItsExtension) {
  fs::path seen;
  publish_file(folder_ / "a.exr", [&](const fs::path& temporary) {
    seen = temporary;
    std::ofstream(temporary) << "x";
  });
  EXPECT_EQ(seen.parent_path(), folder_);
  EXPECT_EQ(seen.extension(), ".exr");
  EXPECT_EQ(seen.filename().string().substr(0, 3), ".a.");
  EXPECT_THAT(seen.filename().string(), HasSubstr(".partial"));
}

TEST_F(Publishing, NeverUsesATemporaryTwice) {
  std::set<fs::path> seen;
  for (int i = 0; i < 100; ++i) {
    publish_file(folder_ / "a.txt", [&](const fs::path& temporary) {
      seen.insert(temporary);
      std::ofstream(temporary) << i;
    });
  }
  EXPECT_EQ(seen.size(), 100u);
}

TEST_F(Publishing, LeavesNothingAndTouchesNothingWhenWritingFails) {
  publish_text(folder_ / "a.txt", "old");
  EXPECT_THROW(publish_file(folder_ / "a.txt",
                            [](const fs::path& temporary) {
                              std::ofstream(temporary) << "half a te";
                              throw std::runtime_error("stop");
                            }),
               std::runtime_error);
  EXPECT_EQ(contents(folder_ / "a.txt"), "old");
  EXPECT_EQ(names(), std::set<std::string>{"a.txt"});
}

TEST_F(Publishing, SaysPathAndReasonWhenAFolderCannotBeMade) {
  publish_text(folder_ / "file", "x");
  const fs::path below = folder_ / "file" / "a.txt";
  const std::string text = output_fault([&] { publish_text(below, "y"); });
  EXPECT_THAT(text, HasSubstr((folder_ / "file").string()));
  EXPECT_THAT(text, HasSubstr("Not a directory"));
}

TEST_F(Publishing, SaysSoWhenAFolderStandsInTheWay) {
  fs::create_directories(folder_ / "a.txt" / "b");
  const std::string text = output_fault([&] { publish_text(folder_ / "a.txt", "y"); });
  EXPECT_THAT(text, HasSubstr("a.txt: cannot put in place: "));
  EXPECT_EQ(names(), std::set<std::string>{"a.txt"});
}

TEST_F(Publishing, SaysSoWhenTheWriterMadeNoFile) {
  EXPECT_THAT(output_fault([&] { publish_file(folder_ / "a.txt", [](const fs::path&) {}); }),
              HasSubstr("a.txt: cannot write: No such file"));
}

TEST_F(Publishing, CopesWithNamesNearTheLongest) {
  const std::string name = std::string(240, 'n') + ".txt";
  publish_text(folder_ / name, "x");
  EXPECT_EQ(names(), std::set<std::string>{name});
}

TEST_F(Publishing, ShowsWholeFilesOnlyWhileManyWriteOne) {
  const fs::path path = folder_ / "a.txt";
  const auto text_of = [](int i) { return std::string(100000, static_cast<char>('a' + i)); };
  publish_text(path, text_of(0));
  std::vector<std::jthread> writers;
  for (int i = 0; i < 4; ++i) {
    writers.emplace_back([&, i] {
      for (int n = 0; n < 20; ++n) publish_text(path, text_of(i));
    });
  }
  for (int n = 0; n < 100; ++n) {
    const std::string found = contents(path);
    ASSERT_EQ(found, std::string(100000, found.empty() ? '?' : found[0]));
  }
  writers.clear();
  EXPECT_EQ(names(), std::set<std::string>{"a.txt"});
}

// A bound on the size of files stands for a full disk.
TEST_F(Publishing, LeavesNothingWhenTheDiskIsFull) {
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const rlimit small{1000, before.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);
  const std::string text =
      output_fault([&] { publish_text(folder_ / "a.txt", std::string(5000, 'x')); });
  setrlimit(RLIMIT_FSIZE, &before);
  EXPECT_THAT(text, HasSubstr("a.txt: cannot write: File too large"));
  EXPECT_TRUE(names().empty());
}

TEST_F(Publishing, TellsWhetherAFolderTakesFiles) {
  require_writable_folder(folder_ / "new");
  EXPECT_TRUE(fs::is_directory(folder_ / "new"));
  EXPECT_TRUE(fs::is_empty(folder_ / "new"));
  publish_text(folder_ / "file", "x");
  EXPECT_THAT(output_fault([&] { require_writable_folder(folder_ / "file"); }),
              HasSubstr("cannot make the folder"));
}

}  // namespace
}  // namespace kiln

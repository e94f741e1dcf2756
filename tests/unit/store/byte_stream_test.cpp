// SPDX-License-Identifier: Apache-2.0
#include "kiln/store/byte_stream.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <fstream>
#include <iterator>

#include "kiln/store/publish.h"
#include "support/faults.h"
#include "support/temporary_folder.h"

namespace kiln {
namespace {

class Streams : public testing::Test {
 protected:
  std::string contents() const {
    std::ifstream file(path_, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  // Differs everywhere, so that nothing displaced goes unnoticed.
  static std::string text_of(size_t count) {
    std::string text;
    for (size_t i = 0; i < count; ++i) text += static_cast<char>('!' + i * i % 89);
    return text;
  }

  const test::TemporaryFolder own_;
  const std::filesystem::path path_ = own_.folder() / "a.bin";
};

TEST_F(Streams, HoldWhatIsAppendedInPiecesOfAnySize) {
  std::string expected;
  publish_stream(path_, [&](ByteStream& out) {
    for (const size_t count : {1, 100, 70000, 3, 65536, 65535, 2}) {
      out.append(text_of(count));
      expected += text_of(count);
      EXPECT_EQ(out.position(), expected.size());
    }
  });
  EXPECT_EQ(contents(), expected);
}

TEST_F(Streams, OverwriteWhereTheyWentBack) {
  publish_stream(path_, [](ByteStream& out) {
    out.append("....tail");
    out.seek(0);
    out.append("head");
    out.seek(8);
    out.append(" end");
  });
  EXPECT_EQ(contents(), "headtail end");
}

TEST_F(Streams, InsertBetweenWhatIsThere) {
  const std::string before = text_of(70), after = text_of(300000);
  publish_stream(path_, [&](ByteStream& out) {
    out.append(before);
    out.append(after);
    out.insert(before.size(), "inserted");
    EXPECT_EQ(out.position(), before.size() + 8 + after.size());
    out.append("end");
  });
  EXPECT_EQ(contents(), before + "inserted" + after + "end");
}

TEST_F(Streams, RememberTheFirstFailureUntilTheyAreAsked) {
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const rlimit small{1000, before.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);
  ByteStream out(path_, "shown.bin");
  out.append(text_of(100000));
  out.append("more");
  const std::string text = test::fault_text(Fault::Output, [&] { out.check(); });
  setrlimit(RLIMIT_FSIZE, &before);
  EXPECT_EQ(text, "shown.bin: cannot write: File too large");
  EXPECT_EQ(test::fault_text(Fault::Output, [&] { out.close(); }), text);
}

TEST_F(Streams, SayWhyAFileCannotBeMade) {
  ByteStream out(path_ / "below", "shown.bin");
  EXPECT_THAT(test::fault_text(Fault::Output, [&] { out.check(); }),
              testing::HasSubstr("shown.bin: cannot write: No such file"));
}

}  // namespace
}  // namespace kiln

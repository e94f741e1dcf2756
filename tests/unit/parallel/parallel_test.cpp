// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <stdexcept>

#include "kiln/parallel/rows.h"
#include "kiln/parallel/threads.h"

namespace kiln {
namespace {

TEST(Rows, AreEachRunOnce) {
  std::vector<std::atomic<int>> runs(1000);
  for_rows(1000, [&](int i) { ++runs[i]; });
  for (const auto& count : runs) EXPECT_EQ(count, 1);
}

TEST(Rows, PassOnAnExceptionOfAnyRow) {
  EXPECT_THROW(for_rows(100,
                        [](int i) {
                          if (i == 57) throw std::runtime_error("row 57");
                        }),
               std::runtime_error);
}

TEST(Rows, SumToTheSameBitsForAnyNumberOfThreads) {
  const auto sum = [] {
    return sum_rows(5000, 2, [](int i, std::vector<double>& share) {
      share[0] = std::sin(i) * 1e10;
      share[1] = 1.0 / (i + 1);
    });
  };
  std::vector<double> one, many;
  {
    const ThreadLimit limit(1);
    one = sum();
  }
  {
    const ThreadLimit limit(8);
    many = sum();
  }
  EXPECT_EQ(one, many);
}

TEST(Threads, AreAtLeastOne) { EXPECT_GE(available_threads(), 1); }

}  // namespace
}  // namespace kiln

// SPDX-License-Identifier: Apache-2.0
#include "kiln/table/lut.h"

#include <gtest/gtest.h>

#include <cmath>

#include "kiln/core/error.h"
#include "kiln/parallel/threads.h"

namespace kiln {
namespace {

TEST(Tables, EachFillsItsChannelsWithReflectances) {
  for (const TableFacts& facts : all_tables()) {
    const Lut lut = build_lut(facts, {16, 8});
    ASSERT_EQ(lut.image.layers.size(), facts.channels.size()) << facts.name;
    for (const Layer& layer : lut.image.layers) {
      for (int y = 0; y < 8; ++y) {
        for (const float value : layer.plane.texels_of_row(y)) {
          EXPECT_GE(value, 0);
          EXPECT_LE(value, 1);
        }
      }
    }
  }
}

TEST(Tables, StateAnEntryErrorBelowOneMillionth) {
  for (const TableFacts& facts : all_tables()) {
    const Lut lut = build_lut(facts, {64, 64});
    EXPECT_LE(lut.entry_error, 1e-6) << facts.name;
    EXPECT_GT(lut.entry_error, 0) << facts.name;
  }
}

TEST(Tables, LieWithTexelCentresAndTheSmoothestRowOnTop) {
  const TableFacts& split_sum = find_table("split-sum");
  const Lut lut = build_lut(split_sum, {8, 4});
  const auto corner = integrate_at(split_sum, 0.5 / 8, 0.5 / 4);
  EXPECT_NEAR(lut.image.layers[0].plane.at(0, 0), corner[0], 1e-6);
  const auto other = integrate_at(split_sum, 7.5 / 8, 3.5 / 4);
  EXPECT_NEAR(lut.image.layers[1].plane.at(7, 3), other[1], 1e-6);
}

TEST(Tables, StateTheLookupErrorThatALinearAxisHas) {
  // A linear cosine axis errs by some 9e-2 near grazing however many entries it has.
  const Lut lut = build_lut(find_table("directional-albedo"), {128, 128});
  EXPECT_GT(lut.lookup_error, 0.03);
  EXPECT_LT(lut.lookup_error, 0.12);
  // Away from grazing it is the clamped half texel at roughness 1 that errs most.
  EXPECT_LT(lut.lookup_error_inner, 5e-3);
}

TEST(Tables, AreTheSameBytesForAnyNumberOfThreads) {
  const auto build = [](int threads) {
    const ThreadLimit limit(threads);
    return integrate_entries(find_table("split-sum"), {33, 17});
  };
  EXPECT_EQ(build(1), build(4));
}

TEST(Tables, UnknownOnesAreRefusedWithTheNearest) {
  try {
    find_table("split-sun");
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "unknown table 'split-sun' (did you mean 'split-sum'?)");
  }
}

}  // namespace
}  // namespace kiln

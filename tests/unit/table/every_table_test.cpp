// SPDX-License-Identifier: Apache-2.0
// What every table of the list must hold.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "table_recipe.h"

namespace kiln {
namespace {

using test::recipe_for;

TEST(EveryTable, FillsItsChannelsAndStatesItsErrors) {
  for (const TableFacts& facts : all_tables()) {
    const Lut lut = build_lut(recipe_for(facts.name, {6, 5}));
    ASSERT_EQ(lut.entries.size(), facts.channels.size()) << facts.name;
    for (const auto& channel : lut.entries) {
      for (const double value : channel) EXPECT_TRUE(std::isfinite(value)) << facts.name;
    }
    const bool fitted = facts.name == "ltc";
    const bool bent = facts.name == "ior-share";  // dense dielectrics are cut off at their F0
    EXPECT_LE(lut.errors.entry, bent ? 5e-5 : 4e-6) << facts.name;
    EXPECT_EQ(lut.errors.lookup > 0, !fitted) << facts.name;
    EXPECT_EQ(lut.errors.fit > 0, fitted) << facts.name;
  }
}

TEST(EveryTable, OfReflectancesHoldsNoneAboveOne) {
  for (const char* table : {"split-sum", "directional-albedo", "average-albedo", "f82", "ior",
                            "anisotropic", "glass"}) {
    const Lut lut = build_lut(recipe_for(table, {6, 5}));
    for (const double value : lut.entries[0]) {
      EXPECT_GE(value, 0) << table;
      EXPECT_LE(value, 1 + 1e-6) << table;
    }
  }
}

TEST(EveryTable, HoldsTheIntegralsAtItsCoordinates) {
  for (const TableFacts& facts : all_tables()) {
    if (facts.name == "ltc") continue;
    const TableRecipe recipe = recipe_for(facts.name, {4, 3});
    const Lut lut = build_lut(recipe);
    std::vector<double> point;
    size_t at = 0, step = 1;
    for (const TableAxis& axis : lut.axes) {
      const int i = axis.count / 2;
      point.push_back(axis.coordinates[i]);
      at += step * i;
      step *= axis.count;
    }
    const auto values = integrate_at(recipe, point);
    for (size_t c = 0; c < values.size(); ++c) {
      EXPECT_NEAR(lut.entries[c][at], values[c], 2e-6) << facts.name << " " << c;
    }
  }
}

}  // namespace
}  // namespace kiln

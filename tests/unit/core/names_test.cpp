// SPDX-License-Identifier: Apache-2.0
#include "kiln/core/names.h"

#include <gtest/gtest.h>

#include "kiln/core/find_named.h"

namespace kiln {
namespace {

TEST(Names, AreSpeltWithDashesInValuesAndUnderscoresInKeys) {
  EXPECT_EQ(kebab("Base_Color"), "base-color");
  EXPECT_EQ(snake("split-sum"), "split_sum");
}

TEST(Names, NearestIsTheOneASlipOfTheHandAway) {
  EXPECT_EQ(nearest_name("ruffness", {"roughness", "metallic"}), "roughness");
  EXPECT_EQ(nearest_name("roughnes", {"metallic", "roughness"}), "roughness");
  EXPECT_EQ(nearest_name("base_colour", {"base-color"}), "base-color");
  EXPECT_EQ(nearest_name("x", {"roughness"}), std::nullopt);
}

TEST(Names, UnknownOnesAreAnsweredWithTheNearestOrWithTheList) {
  EXPECT_EQ(unknown_name("table", "splt-sum", {"split-sum"}),
            "unknown table 'splt-sum' (did you mean 'split-sum'?)");
  EXPECT_EQ(unknown_name("table", "zzz", {"a-b", "c-d"}), "unknown table 'zzz' (known: a-b, c-d)");
}

TEST(Names, FindTheThingsOfAList) {
  struct Thing {
    std::string name;
    int number;
  };
  const std::vector<Thing> things{{"split-sum", 1}, {"sheen", 2}};
  EXPECT_EQ(find_named(things, "thing", "Split_Sum").number, 1);
  EXPECT_THROW(find_named(things, "thing", "shen"), Error);
}

}  // namespace
}  // namespace kiln

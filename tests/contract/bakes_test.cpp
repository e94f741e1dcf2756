// SPDX-License-Identifier: Apache-2.0
// Every bake on the list. A new bake is tested by being listed.
#include <gtest/gtest.h>

#include "kiln/bake/bake.h"

namespace kiln {
namespace {

TEST(EveryBake, SaysWhatItDoesAndWhatItTakes) {
  for (const BakeFacts& bake : all_bakes()) {
    EXPECT_FALSE(bake.summary.empty()) << bake.name;
    for (const ParamFacts& param : bake.params) {
      EXPECT_FALSE(param.meaning.empty()) << bake.name << "." << param.name;
      EXPECT_EQ(param.name, snake(param.name));
    }
  }
}

TEST(EveryBake, AcceptsItsOwnDefaults) {
  for (const BakeFacts& bake : all_bakes()) {
    const auto recipe = make_recipe(bake.name);
    for (const ParamFacts& param : bake.params) {
      if (param.default_text == "input") continue;  // a size taken from the maps
      if (param.default_text.empty()) continue;     // decided by other settings
      EXPECT_NO_THROW(recipe->set(param.name, param.default_text))
          << bake.name << "." << param.name;
    }
  }
}

TEST(EveryBake, AcceptsEveryChoiceOfItsWords) {
  for (const BakeFacts& bake : all_bakes()) {
    for (const ParamFacts& param : bake.params) {
      for (const std::string& choice : param.choices) {
        EXPECT_NO_THROW(make_recipe(bake.name)->set(param.name, choice)) << param.name;
      }
    }
  }
}

TEST(EveryBake, RefusesAnUnknownParameter) {
  for (const BakeFacts& bake : all_bakes()) {
    EXPECT_THROW(make_recipe(bake.name)->set("no_such_thing", "1"), Error) << bake.name;
  }
}

TEST(EveryBake, OncePerPipelineNeedsNoMaterial) {
  for (const BakeFacts& bake : all_bakes()) {
    const Needs needs = make_recipe(bake.name)->needs();
    EXPECT_EQ(needs.material || needs.maps.any(), bake.scope == Scope::PerSet) << bake.name;
  }
}

TEST(Bakes, UnknownOnesAreRefusedWithTheNearest) {
  try {
    make_recipe("previw");
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::Usage);
    EXPECT_STREQ(error.what(), "unknown bake 'previw' (did you mean 'preview'?)");
  }
}

}  // namespace
}  // namespace kiln

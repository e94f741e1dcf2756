// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "kiln/bake/bake.h"
#include "kiln/bake/lut.h"

namespace kiln {
namespace {

TEST(LutBake, SaysInTheFileWhatTheTableIsAndHowWrong) {
  const auto recipe = make_recipe("lut");
  recipe->set("size", "16");
  const Baked baked = recipe->bake({});
  std::string all;
  for (const auto& [name, text] : baked.artifacts.at(0).attributes) all += name + "=" + text + "\n";
  for (const char* wanted :
       {"kiln:table=split-sum", "distribution=ggx", "kiln:axes=x=mu", "kiln:alignment=center",
        "kiln:origin=top", "kiln:entry_error=", "kiln:lookup_error=", "kiln:channel_R=scale"}) {
    EXPECT_NE(all.find(wanted), std::string::npos) << wanted;
  }
}

TEST(LutBake, IntegratesAtOnePointToItsClosedForm) {
  EXPECT_NEAR(integrate_at("directional-albedo", 0.3, 1.0).at(0), 1 - 0.3 * std::log1p(1 / 0.3),
              1e-11);
}

TEST(LutBake, RefusesAPointOutsideTheDomain) {
  EXPECT_THROW(integrate_at("split-sum", 0, 0.5), Error);
  EXPECT_THROW(integrate_at("split-sum", 0.5, 1.5), Error);
  EXPECT_THROW(integrate_at("split-sum", NAN, 0.5), Error);
}

}  // namespace
}  // namespace kiln

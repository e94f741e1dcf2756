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

TEST(LutBake, HandsLargeVolumesOverInBandsOfSlices) {
  const auto bake = [](const std::string& depth) {
    const auto recipe = make_recipe("lut");
    for (const auto& [key, text] : LutWords{{"table", "ior"},
                                            {"axes", "f0,mu,roughness"},
                                            {"channels", "scale,one"},
                                            {"size", "4x600"},
                                            {"depth", depth}}) {
      recipe->set(key, text);
    }
    return recipe->bake({}).artifacts.at(0);
  };
  const Artifact small = bake("3");
  EXPECT_EQ(small.image.size, (Size{4, 1800}));
  EXPECT_EQ(small.bands.size, Size{});
  const Artifact large = bake("120");
  EXPECT_TRUE(large.image.layers.empty());
  EXPECT_EQ(large.bands.size, (Size{4, 72000}));
  EXPECT_EQ(large.bands.names, (std::vector<std::string>{"R", "G"}));
  EXPECT_EQ(large.bands.band_rows % 600, 0);
  const Layers band = large.bands.make(0, large.bands.band_rows);
  EXPECT_EQ(band.size, (Size{4, large.bands.band_rows}));
  EXPECT_EQ(band.layers.at(1).name, "G");
}

TEST(LutBake, IntegratesAtOnePointToItsClosedForm) {
  const auto values = integrate_at({{"table", "directional-albedo"}}, {0.3, 1.0});
  EXPECT_EQ(values.at(0).channel, "total");
  EXPECT_NEAR(values.at(0).value, 1 - 0.3 * std::log1p(1 / 0.3), 1e-11);
}

TEST(LutBake, RefusesAPointOutsideTheDomain) {
  const LutWords split_sum = {{"table", "split-sum"}};
  EXPECT_THROW(integrate_at(split_sum, {0, 0.5}), Error);
  EXPECT_THROW(integrate_at(split_sum, {0.5, 1.5}), Error);
  EXPECT_THROW(integrate_at(split_sum, {NAN, 0.5}), Error);
  EXPECT_THROW(integrate_at(split_sum, {0.5}), Error);
}

TEST(LutBake, RefusesBeforeItBakesWhatDoesNotFit) {
  const std::vector<LutWords> refused = {
      {{"table", "split-sum"}, {"fresnel", "dielectric"}},
      {{"table", "split-sum"}, {"masking", "estevez-kulla"}},
      {{"table", "average-albedo"}, {"channels", "scale"}},
      {{"table", "split-sum"}, {"preset", "cycles"}},
      {{"table", "split-sum"}, {"axes", "mu"}},
      {{"table", "split-sum"}, {"shape", "3"}},
  };
  for (const LutWords& words : refused) {
    const auto recipe = make_recipe("lut");
    for (const auto& [key, text] : words) recipe->set(key, text);
    EXPECT_THROW(recipe->needs(), Error) << words.back().first << " " << words.back().second;
  }
}

}  // namespace
}  // namespace kiln

// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "kiln/bake/bake.h"
#include "kiln/bake/lut.h"

namespace kiln {
namespace {

// Every table of every preset, small: built, described and free of nonsense.
TEST(EveryLutPreset, MakesItsTables) {
  for (const NamedText& preset : list_lut_presets()) {
    int tables = 0;
    for (const auto& [table, settings] : preset.facts) {
      if (table == "type" || table == "note") continue;
      const auto recipe = make_recipe("lut");
      recipe->set("table", table);
      recipe->set("preset", preset.name);
      recipe->set("size", "8x6");
      recipe->set("depth", "3");
      const Baked baked = recipe->bake({});
      const Artifact& artifact = baked.artifacts.at(0);
      for (const Layer& layer : artifact.image.layers) {
        for (const float value : layer.plane.texels_of_row(1 % artifact.image.size.height)) {
          EXPECT_TRUE(std::isfinite(value)) << preset.name;
        }
      }
      ++tables;
    }
    EXPECT_GE(tables, 1) << preset.name;
  }
}

}  // namespace
}  // namespace kiln

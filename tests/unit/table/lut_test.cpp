// SPDX-License-Identifier: Apache-2.0
#include "kiln/table/lut.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>

#include "kiln/core/error.h"
#include "kiln/parallel/threads.h"
#include "kiln/table/snippet.h"
#include "support/faults.h"
#include "support/temporary_folder.h"
#include "table_recipe.h"

namespace kiln {
namespace {

using test::recipe_for;
using testing::HasSubstr;

TEST(Tables, StateAnEntryErrorBelowOneMillionth) {
  for (const char* table : {"split-sum", "directional-albedo", "f82"}) {
    const Lut lut = build_lut(recipe_for(table, {64, 64}));
    EXPECT_LE(lut.errors.entry, 1e-6) << table;
    EXPECT_GT(lut.errors.entry, 0) << table;
  }
}

TEST(Tables, AreExactToTenDigitsWhenAsked) {
  TableRecipe recipe = recipe_for("split-sum", {80, 60});
  recipe.exact = true;
  const Lut lut = build_lut(recipe);
  EXPECT_LE(lut.errors.entry, 1e-10);
}

TEST(Tables, LieWithTexelCentresAndTheSmoothestRowOnTop) {
  const TableRecipe recipe = recipe_for("split-sum", {8, 4});
  const Layers image = LutSource(recipe).image(0, 1);
  const auto corner = integrate_at(recipe, {0.5 / 8, 0.5 / 4});
  EXPECT_NEAR(image.layers[0].plane.at(0, 0), corner[0], 1e-6);
  const auto other = integrate_at(recipe, {7.5 / 8, 3.5 / 4});
  EXPECT_NEAR(image.layers[1].plane.at(7, 3), other[1], 1e-6);
}

TEST(Tables, FlippedOnesHoldTheSameRowsFromTheBottom) {
  TableRecipe recipe = recipe_for("split-sum", {8, 4});
  const Layers top = LutSource(recipe).image(0, 1);
  recipe.origin = Origin::Bottom;
  const Layers bottom = LutSource(recipe).image(0, 1);
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 8; ++x) {
      EXPECT_EQ(top.layers[0].plane.at(x, y), bottom.layers[0].plane.at(x, 3 - y));
    }
  }
}

TEST(Tables, TransposedOnesSwapTheirAxes) {
  TableRecipe recipe = recipe_for("split-sum", {8, 8});
  const Layers plain = LutSource(recipe).image(0, 1);
  recipe.axes = {"roughness", "mu"};
  const Layers swapped = LutSource(recipe).image(0, 1);
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 8; ++x) {
      EXPECT_EQ(plain.layers[1].plane.at(x, y), swapped.layers[1].plane.at(y, x));
    }
  }
}

TEST(Tables, StateTheLookupErrorThatALinearAxisHas) {
  // A linear cosine axis errs by some 9e-2 near grazing however many entries it has.
  const Lut lut = build_lut(recipe_for("directional-albedo", {128, 128}));
  EXPECT_GT(lut.errors.lookup, 0.03);
  EXPECT_LT(lut.errors.lookup, 0.12);
  // Away from grazing it is the clamped half texel at roughness 1 that errs most.
  EXPECT_LT(lut.errors.lookup_inner, 5e-3);
}

TEST(Tables, ReadBetterOverASquareRootAxis) {
  TableRecipe recipe = recipe_for("directional-albedo", {128, 128});
  recipe.alignment = Alignment::Corner;
  recipe.axes = {"sqrt-mu", "roughness"};
  EXPECT_LT(build_lut(recipe).errors.lookup, 2.5e-2);
}

TEST(Tables, AreTheSameBytesForAnyNumberOfThreads) {
  const auto build = [](int threads) {
    const ThreadLimit limit(threads);
    return build_lut(recipe_for("split-sum", {70, 65})).entries;
  };
  EXPECT_EQ(build(1), build(4));
}

TEST(Tables, UnknownWordsAreRefusedWithTheNearest) {
  EXPECT_THAT(test::fault_text(Fault::Usage, [&] { find_table("split-sun"); }),
              HasSubstr("unknown table 'split-sun' (did you mean 'split-sum'?)"));
  TableRecipe recipe = recipe_of(find_table("split-sum"));
  recipe.axes = {"mu", "rougness"};
  EXPECT_THAT(test::fault_text(Fault::Usage, [&] { complete(recipe); }),
              HasSubstr("did you mean 'roughness'?"));
  recipe.axes = {"mu", "sqrt-mu"};
  EXPECT_THAT(test::fault_text(Fault::Usage, [&] { complete(recipe); }),
              HasSubstr("found mu twice"));
  recipe.axes = {"mu", "f0"};
  EXPECT_THAT(test::fault_text(Fault::Usage, [&] { complete(recipe); }),
              HasSubstr("runs over mu, roughness"));
}

TEST(Axes, PositionIsTheInverseOfValue) {
  for (const AxisMapping& mapping : all_axis_mappings()) {
    for (const double u : {0.0, 0.1, 0.37, 0.8, 0.98}) {
      const double expected = mapping.name == "schlick-exponent" ? std::max(u, 1e-4) : u;
      EXPECT_NEAR(mapping.position(mapping.value(u)), expected, 1e-12) << mapping.name;
    }
    for (const std::string& alias : mapping.aliases) {
      EXPECT_EQ(find_axis_mapping(alias).name, mapping.name);
    }
  }
}

// The C++ snippet is compiled, run over the table and compared with the lookups that it states.
TEST(Snippets, LookUpTheTableTheyAreMadeFor) {
  const test::TemporaryFolder folder;
  for (const char* table : {"split-sum", "average-albedo", "glass"}) {
    TableRecipe recipe = recipe_for(table, {12, 9}, 4);
    recipe.alignment = Alignment::Corner;
    const Lut lut = build_lut(recipe);
    LutSource lookups(recipe);
    std::string name = "kiln_" + recipe.table, arguments;
    for (char& c : name) c = c == '-' ? '_' : c;
    std::vector<double> point;
    for (size_t a = 0; a < lut.axes.size(); ++a) {
      point.push_back(lut.axes[a].mapping.value(0.3 + 0.2 * static_cast<double>(a)));
      arguments += ", " + std::to_string(point.back()) + "f";
    }
    std::ofstream source(folder.folder() / "lookup.cpp");
    source << lookup_snippet(lookups, SnippetLanguage::Cpp, "t.h", false) << "\n#include <cstdio>\n"
           << "const float texels[] = {";
    for (size_t i = 0; i < lut.entries[0].size(); ++i) {
      for (const auto& channel : lut.entries) source << static_cast<float>(channel[i]) << ",";
    }
    source << "};\nint main() { const auto v = " << name << "(texels" << arguments << ");\n"
           << "  for (float x : v) std::printf(\"%.9g\\n\", x);\n}\n";
    source.close();
    const std::string here = folder.folder().string();
    const std::string command = std::string(KILN_CXX_COMPILER) + " -std=c++17 -Wall -Werror " +
                                here + "/lookup.cpp -o " + here + "/lookup && " + here +
                                "/lookup > " + here + "/values";
    ASSERT_EQ(std::system(command.c_str()), 0) << table;
    std::ifstream values(folder.folder() / "values");
    for (const double expected : look_up(lookups, point)) {
      double value = -1;
      values >> value;
      EXPECT_NEAR(value, expected, 2e-5) << table;
    }
  }
}

TEST(Snippets, StateFivePointsAndDecodeRgbd) {
  TableRecipe recipe = recipe_for("split-sum", {8, 8});
  recipe.origin = Origin::Bottom;
  LutSource lut(recipe);
  const std::string glsl = lookup_snippet(lut, SnippetLanguage::Glsl, "dfg.dds", true);
  EXPECT_THAT(glsl, HasSubstr("vec2 kiln_split_sum(sampler2D table, float mu"));
  EXPECT_THAT(glsl, HasSubstr("1.0 - (roughness)"));
  EXPECT_THAT(glsl, HasSubstr("pow(stored.rgb, vec3(2.2)) / stored.a"));
  size_t points = 0;
  for (size_t at = glsl.find("//   kiln_"); at != std::string::npos;
       at = glsl.find("//   kiln_", at + 1)) {
    ++points;
  }
  EXPECT_EQ(points, 5u);
  EXPECT_THAT(lookup_snippet(lut, SnippetLanguage::Hlsl, "dfg.dds", false),
              HasSubstr("table.SampleLevel(linear_clamp, at, 0)"));
}

}  // namespace
}  // namespace kiln

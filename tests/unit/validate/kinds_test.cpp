// SPDX-License-Identifier: Apache-2.0
// Tables beside integrals of a lobe over n.v and roughness, from their numbers alone.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "kiln/table/lut.h"
#include "made_table.h"

namespace kiln {
namespace {

using test::make_table;
using test::summary;
using testing::Contains;
using testing::HasSubstr;

TableRecipe recipe(const std::string& table, Size size, int depth = 8) {
  TableRecipe recipe = recipe_of(find_table(table));
  recipe.size = size;
  recipe.depth = depth;
  return recipe;
}

NumberArray numbers(TableRecipe recipe) {
  complete(recipe);
  const Lut lut = build_lut(recipe);
  NumberArray array;
  array.shape = {recipe.size.height, recipe.size.width, static_cast<int>(lut.entries.size())};
  if (recipe.depth > 1) array.shape.insert(array.shape.begin(), recipe.depth);
  for (size_t i = 0; i < lut.entries[0].size(); ++i) {
    for (const auto& channel : lut.entries) {
      array.values.push_back(static_cast<float>(channel[i]));
    }
  }
  return array;
}

void expect_exact(const Verdict& verdict, const std::string& table) {
  EXPECT_TRUE(verdict.fits) << summary(verdict);
  EXPECT_EQ(verdict.best.table_class, table) << summary(verdict);
  EXPECT_LT(verdict.best.max_error, 5e-6) << summary(verdict);
  EXPECT_GT(verdict.ratio, 10) << summary(verdict) << verdict.runner_up->convention;
}

TEST(Kinds, DiffuseModelsAreNamed) {
  TableRecipe wanted = recipe("diffuse", {24, 20});
  wanted.channels = {"diffuse-fujii", "diffuse-hammon"};
  const Verdict verdict = verify_tables({numbers(wanted)});
  expect_exact(verdict, "diffuse");
  EXPECT_THAT(verdict.best.channels[0].quantity, HasSubstr("fujii"));
  EXPECT_THAT(verdict.best.channels[1].quantity, HasSubstr("hammon"));
}

TEST(Kinds, GlassKeepsItsSidesApart) {
  TableRecipe wanted = recipe("glass", {8, 8});
  const Verdict verdict = verify_tables({numbers(wanted)});
  expect_exact(verdict, "glass");
  EXPECT_EQ(verdict.best.channels[0].quantity, "entering: share of energy reflected");
  EXPECT_EQ(verdict.best.channels[3].quantity, "leaving: share of energy let through");
}

TEST(Kinds, ReflectancesByIndexAreFoundOnAnyAxes) {
  TableRecipe wanted = recipe("ior", {8, 10}, 6);
  wanted.axes = {"alpha", "mu", "f0"};
  wanted.alignment = Alignment::Corner;
  wanted.origin = Origin::Bottom;
  const Verdict verdict = verify_tables({numbers(wanted)});
  EXPECT_TRUE(verdict.fits) << summary(verdict);
  EXPECT_EQ(verdict.best.table_class, "ior") << summary(verdict);
  EXPECT_LT(verdict.best.rms_error, 1e-5) << summary(verdict);
  EXPECT_THAT(verdict.best.convention,
              HasSubstr("x = alpha = roughness^2, y = n.v, from the other end, z = F0"));
}

TEST(Kinds, AnisotropyIsFound) {
  expect_exact(verify_tables({numbers(recipe("anisotropic", {8, 8}, 4))}), "anisotropic");
}

TEST(Kinds, SkinIsFound) {
  expect_exact(verify_tables({numbers(recipe("skin", {24, 24}))}), "skin");
}

TEST(Kinds, SlicesBelowEachOtherInOneImageAreFound) {
  NumberArray array = numbers(recipe("ior", {8, 8}, 6));
  array.shape = {48, 8, 1};
  const Verdict verdict = verify_tables({array});
  EXPECT_TRUE(verdict.fits) << summary(verdict);
  EXPECT_EQ(verdict.best.table_class, "ior") << summary(verdict);
  EXPECT_LT(verdict.best.max_error, 5e-6) << summary(verdict);
  EXPECT_THAT(verdict.statements, Contains(HasSubstr("entering: share of energy reflected")));
}

TEST(Kinds, OtherTablesOfAFileAreListed) {
  std::vector<NumberArray> arrays{numbers(recipe("skin", {24, 24})), make_table({})};
  arrays[0].name = "skin";
  arrays[1].name = "brdf";
  const Verdict verdict = verify_tables(arrays);
  EXPECT_TRUE(verdict.fits) << summary(verdict);
  ASSERT_EQ(verdict.others.size(), 1);
  const Match& other = verdict.others[0];
  EXPECT_NE(other.array, verdict.best.array);
  EXPECT_EQ(other.table_class, other.array == "skin" ? "skin" : "split-sum");
}

TEST(Kinds, SolidNoiseFitsNothing) {
  NumberArray array = numbers(recipe("ior", {8, 8}, 6));
  for (size_t i = 0; i < array.values.size(); ++i) array.values[i] = 0.5 + 0.5 * std::sin(1e4 * i);
  EXPECT_FALSE(verify_tables({array}).fits);
  for (size_t i = 0; i < array.values.size(); ++i) {
    array.values[i] = (i % 8 + 0.5) / 8 * (i / 64 + 0.5) / 6;
  }
  EXPECT_FALSE(verify_tables({array}).fits);
}

}  // namespace
}  // namespace kiln

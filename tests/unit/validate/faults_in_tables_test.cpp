// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "kiln/math/hash.h"
#include "made_table.h"

namespace kiln {
namespace {

using test::make_table;
using test::Recipe;
using test::summary;
using testing::Contains;
using testing::HasSubstr;
using testing::StartsWith;

TEST(FaultsInTables, RowsOneTooFarAreNamedWithTheErrorTheyCost) {
  const Verdict verdict = verify_tables({make_table({.row_shift = 1})});
  EXPECT_TRUE(verdict.fits);
  EXPECT_LT(verdict.best.max_error, 1e-5) << summary(verdict);
  EXPECT_THAT(verdict.statements,
              Contains(StartsWith("rows hold the roughness of the next row: greatest error 0.")));
  EXPECT_THAT(verdict.presets, Contains("khronos"));
}

TEST(FaultsInTables, ColumnsOneTooFarAreNamed) {
  const Verdict verdict = verify_tables({make_table({.column_shift = -1})});
  EXPECT_TRUE(verdict.fits);
  EXPECT_THAT(verdict.statements,
              Contains(StartsWith("columns hold the n.v of the previous column")));
}

TEST(FaultsInTables, HalfAnEntryIsNamed) {
  const Verdict verdict = verify_tables({make_table({.row_shift = -0.5})});
  EXPECT_TRUE(verdict.fits);
  EXPECT_THAT(verdict.statements,
              Contains(StartsWith("rows hold the roughness half a row below their centres")));
}

TEST(FaultsInTables, DisplayEncodingIsNamed) {
  NumberArray array = make_table({});
  array.stored = NumberArray::Stored::Uint8;
  for (double& v : array.values) {
    const double encoded = v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
    v = std::round(255 * encoded) / 255;
  }
  const Verdict verdict = verify_tables({array});
  EXPECT_TRUE(verdict.fits) << summary(verdict);
  EXPECT_THAT(verdict.statements, Contains(HasSubstr("sRGB-encoded")));
}

TEST(FaultsInTables, SwappedChannelsAreNamed) {
  const Verdict verdict = verify_tables({make_table({.channels = [](const test::Terms& terms) {
    return std::vector{terms.bias, terms.scale};
  }})});
  EXPECT_TRUE(verdict.fits);
  EXPECT_THAT(verdict.statements, Contains(HasSubstr("swapped")));
}

TEST(FaultsInTables, RoughnessSquaredTwiceIsNamed) {
  const Verdict verdict =
      verify_tables({make_table({.alpha = [](double u) { return u * u * u * u; }})});
  EXPECT_TRUE(verdict.fits);
  EXPECT_THAT(verdict.statements, Contains(HasSubstr("squared once too often")));
}

TEST(FaultsInTables, MetadataThatDisagreesIsNamed) {
  NumberArray array = make_table({});
  array.attributes = {{"kiln:models", "distribution=ggx masking=smith-separable fresnel=schlick"},
                      {"kiln:axes", "x=roughness (perceptual), y=mu (n.v)"}};
  const Verdict verdict = verify_tables({array});
  EXPECT_THAT(verdict.statements, Contains("metadata says masking smith-separable, the entries "
                                           "are of smith-correlated"));
  EXPECT_THAT(verdict.statements, Contains(HasSubstr("but the table is transposed")));
}

TEST(FaultsInTables, NoiseIsSaidInSamples) {
  NumberArray array = make_table({});
  for (size_t i = 0; i < array.values.size(); ++i) {
    // Uniform noise of the standard deviation of a thousand samples.
    const double u = static_cast<double>(mix_bits(static_cast<uint32_t>(i))) / 4294967296.0;
    array.values[i] += 0.0026 * std::sqrt(12.0) * (u - 0.5);
  }
  const Verdict verdict = verify_tables({array});
  EXPECT_TRUE(verdict.fits) << summary(verdict);
  EXPECT_EQ(verdict.best.axes, TableAxes{}) << summary(verdict);
  EXPECT_THAT(verdict.statements, Contains(HasSubstr("about 1024 samples")));
}

TEST(FaultsInTables, NumbersThatAreNoneAreCounted) {
  NumberArray array = make_table({});
  array.values[17] = std::nan("");
  const Verdict verdict = verify_tables({array});
  EXPECT_THAT(verdict.statements, Contains("1 of 2048 numbers are not finite"));
}

TEST(FaultsInTables, TheWorstEntryIsFound) {
  NumberArray array = make_table({});
  array.values[2 * (20 * 32 + 9)] += 0.05;
  const Verdict verdict = verify_tables({array}, {.max_error = 0.01});
  EXPECT_TRUE(verdict.fits) << summary(verdict);
  EXPECT_FALSE(verdict.within);
  EXPECT_NEAR(verdict.best.max_error, 0.05, 1e-5);
  EXPECT_EQ(verdict.best.x, 9);
  EXPECT_EQ(verdict.best.y, 20);
  EXPECT_NEAR(verdict.best.mu, 9.5 / 32, 1e-12);
  EXPECT_NEAR(verdict.best.roughness, 20.5 / 32, 1e-12);
  EXPECT_NEAR(verdict.errors.layers.at(0).plane.at(9, 20), 0.05, 1e-5);
}

}  // namespace
}  // namespace kiln

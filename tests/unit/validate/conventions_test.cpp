// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "made_table.h"

namespace kiln {
namespace {

using test::make_table;
using test::Recipe;
using test::summary;

Verdict verify(const Recipe& recipe) { return verify_tables({make_table(recipe)}); }

void expect_exact(const Verdict& verdict) {
  EXPECT_TRUE(verdict.fits) << summary(verdict);
  EXPECT_LT(verdict.best.max_error, 5e-6) << summary(verdict);
  EXPECT_GT(verdict.ratio, 10) << summary(verdict);
  EXPECT_TRUE(verdict.statements.empty()) << summary(verdict);
}

TEST(Conventions, CentredRoughnessOverCosineIsThatOfManyEngines) {
  const Verdict verdict = verify({});
  expect_exact(verdict);
  EXPECT_EQ(verdict.best.table_class, "split-sum");
  EXPECT_EQ(verdict.best.axes, TableAxes{});
  EXPECT_EQ(verdict.best.channels[0].quantity, "scale");
  EXPECT_EQ(verdict.best.channels[1].quantity, "bias");
  EXPECT_EQ(verdict.best.channels[0].masking, "smith-correlated");
  const std::vector<std::string> engines{"khronos", "unreal"};
  EXPECT_EQ(verdict.presets, engines);
}

TEST(Conventions, TransposedTablesAreToldApart) {
  const Verdict verdict = verify({.transposed = true});
  expect_exact(verdict);
  EXPECT_TRUE(verdict.best.axes.transposed);
  EXPECT_EQ(verdict.presets, std::vector<std::string>{"three"});
}

TEST(Conventions, ReversedRowsAndColumnsAreToldApart) {
  for (const bool columns : {false, true}) {
    for (const bool rows : {false, true}) {
      const Verdict verdict = verify({.columns_reversed = columns, .rows_reversed = rows});
      expect_exact(verdict);
      EXPECT_EQ(verdict.best.axes.cosine_reversed, columns) << summary(verdict);
      EXPECT_EQ(verdict.best.axes.width_reversed, rows) << summary(verdict);
    }
  }
}

TEST(Conventions, EveryAxisOfDirectionsIsToldFromTheOthers) {
  const std::vector<std::pair<CosineAxis, double (*)(double)>> maps{
      {CosineAxis::Cosine, [](double u) { return u; }},
      {CosineAxis::SquareRoot, [](double u) { return u * u; }},
      {CosineAxis::CubeRoot, [](double u) { return u * u * u; }},
      {CosineAxis::OneMinusRoot, [](double u) { return 1 - (1 - u) * (1 - u); }}};
  for (const auto& [axis, map] : maps) {
    const Verdict verdict = verify({.mu = map});
    expect_exact(verdict);
    EXPECT_EQ(verdict.best.axes.cosine, axis) << summary(verdict);
  }
}

TEST(Conventions, AlphaAlongAnAxisIsToldFromRoughness) {
  const Verdict verdict = verify({.alpha = [](double u) { return u; }});
  expect_exact(verdict);
  EXPECT_EQ(verdict.best.axes.width, WidthAxis::Alpha) << summary(verdict);
  EXPECT_EQ(verdict.presets, std::vector<std::string>{"materialx"});
}

TEST(Conventions, NodesAreToldFromCentres) {
  const Verdict verdict = verify({.mu = [](double u) { return u * u; }, .nodes = true});
  EXPECT_TRUE(verdict.fits) << summary(verdict);
  EXPECT_LT(verdict.best.rms_error, 1e-6) << summary(verdict);
  EXPECT_TRUE(verdict.best.axes.cosine_alignment.nodes) << summary(verdict);
  EXPECT_TRUE(verdict.best.axes.width_alignment.nodes) << summary(verdict);
}

TEST(Conventions, TheAxesOfLinearlyTransformedCosinesAreKnown) {
  const Verdict verdict = verify({.width = 64,
                                  .height = 64,
                                  .channels =
                                      [](const test::Terms& t) {
                                        return std::vector{t.total(), t.bias};
                                      },
                                  .mu = [](double u) { return 1 - u * u; },
                                  .transposed = true,
                                  .nodes = true});
  EXPECT_TRUE(verdict.fits) << summary(verdict);
  EXPECT_EQ(verdict.presets, std::vector<std::string>{"ltc"}) << summary(verdict);
}

TEST(Conventions, ChannelsAreNamedByWhatTheyHold) {
  const Verdict verdict = verify({.channels = [](const test::Terms& terms) {
    return std::vector{terms.bias, terms.total(), 0.0, 1 - terms.total()};
  }});
  expect_exact(verdict);
  EXPECT_EQ(verdict.best.channels[0].quantity, "bias");
  EXPECT_EQ(verdict.best.channels[1].quantity, "albedo");
  EXPECT_EQ(verdict.best.channels[2].quantity, "constant 0");
  EXPECT_EQ(verdict.best.channels[3].quantity, "1 - albedo");
}

TEST(Conventions, LobesAreToldFromEachOther) {
  const std::vector<Lobe> lobes{{"ggx", "smith-separable"},
                                {"ggx", "schlick-ggx"},
                                {"ggx", "hammon"},
                                {"ggx", "v-cavity"},
                                {"beckmann", "smith-correlated"},
                                {"beckmann", "smith-separable"}};
  for (const Lobe& lobe : lobes) {
    const Verdict verdict = verify({.width = 16, .height = 16, .lobe = lobe});
    EXPECT_TRUE(verdict.fits) << lobe.distribution << " " << lobe.masking << summary(verdict);
    EXPECT_EQ(verdict.best.channels[0].distribution, lobe.distribution) << summary(verdict);
    EXPECT_EQ(verdict.best.channels[0].masking, lobe.masking) << summary(verdict);
    EXPECT_LT(verdict.best.max_error, 5e-6) << summary(verdict);
  }
}

TEST(Conventions, UnrealsJointMaskingIsHammons) {
  const Verdict verdict = verify({.width = 16, .height = 16, .lobe = {"ggx", "unreal-joint"}});
  EXPECT_EQ(verdict.best.channels[0].masking, "hammon") << summary(verdict);
  EXPECT_EQ(verdict.presets, std::vector<std::string>{"unreal"});
}

TEST(Conventions, ClothIsFoundAloneToo) {
  for (const char* masking : {"neubelt", "estevez-kulla"}) {
    const Verdict verdict =
        verify({.lobe = {"charlie", masking},
                .channels = [](const auto& terms) { return std::vector{terms.total()}; }});
    EXPECT_TRUE(verdict.fits) << masking << summary(verdict);
    EXPECT_EQ(verdict.best.table_class, "sheen") << summary(verdict);
    EXPECT_EQ(verdict.best.channels[0].masking, masking) << summary(verdict);
  }
}

TEST(Conventions, TablesOfUnequalSidesAreFound) {
  const Verdict verdict = verify({.width = 64, .height = 16});
  expect_exact(verdict);
}

TEST(Conventions, NumbersWithoutAShapeAreArranged) {
  NumberArray array = make_table({.width = 16, .height = 16, .transposed = true});
  array.shape = {static_cast<int>(array.values.size())};
  array.stored = NumberArray::Stored::Decimal;
  const Verdict verdict = verify_tables({array});
  expect_exact(verdict);
  EXPECT_EQ(verdict.best.arrangement, "16 x 16 x 2, interleaved");
}

TEST(Conventions, ChannelsInArraysOfTheirOwnAreJoined) {
  const auto channel = [](int c) {
    NumberArray array = make_table({.channels = [c](const test::Terms& terms) {
      return std::vector{c == 0 ? terms.scale : terms.bias};
    }});
    array.name = c == 0 ? "dfg_scale" : "dfg_bias";
    return array;
  };
  const Verdict verdict = verify_tables({channel(0), channel(1)});
  EXPECT_TRUE(verdict.fits) << summary(verdict);
  EXPECT_EQ(verdict.best.table_class, "split-sum") << summary(verdict);
  EXPECT_EQ(verdict.best.array, "dfg_scale, dfg_bias");
}

TEST(Conventions, BytesAndTheirStepAreUnderstood) {
  NumberArray array = make_table({});
  array.stored = NumberArray::Stored::Uint8;
  for (double& value : array.values) value = std::round(value * 255) / 255;
  const Verdict verdict = verify_tables({array});
  EXPECT_TRUE(verdict.fits) << summary(verdict);
  EXPECT_LT(verdict.best.max_error, 0.51 / 255) << summary(verdict);
  EXPECT_EQ(verdict.best.axes, TableAxes{}) << summary(verdict);
}

TEST(Conventions, BytesOverADivisorAreUnderstood) {
  NumberArray array = make_table({.channels = [](const test::Terms& terms) {
    const double divisor = 1 - 0.3 * terms.bias;
    const auto encode = [&](double value) { return std::pow(value * divisor, 1 / 2.2); };
    return std::vector{encode(terms.bias), encode(terms.total()), encode(0.5), divisor};
  }});
  array.stored = NumberArray::Stored::Uint8;
  const Verdict verdict = verify_tables({array});
  EXPECT_TRUE(verdict.fits) << summary(verdict);
  EXPECT_EQ(verdict.best.channels[0].quantity, "bias") << summary(verdict);
  EXPECT_EQ(verdict.best.channels[1].quantity, "albedo") << summary(verdict);
  EXPECT_NE(verdict.best.decoding.find("RGBD"), std::string::npos) << summary(verdict);
}

TEST(Conventions, AveragesOverDirectionsAreCurves) {
  NumberArray array;
  for (int i = 0; i < 64; ++i) {
    const double u = (i + 0.5) / 64, alpha = std::max(u * u, 1e-4);
    double sum = 0;
    const int steps = 400;
    std::vector<double> mus(steps);
    for (int k = 0; k < steps; ++k) mus[k] = (k + 0.5) / steps;
    const std::vector<double> alphas{alpha};
    const auto terms = integrate_grid({}, mus, alphas, Quality::Table);
    for (int k = 0; k < steps; ++k) sum += 2 * mus[k] * terms[k].total() / steps;
    array.values.push_back(sum);
  }
  array.shape = {64};
  array.stored = NumberArray::Stored::Decimal;
  const Verdict verdict = verify_tables({array});
  EXPECT_TRUE(verdict.fits) << summary(verdict);
  EXPECT_EQ(verdict.best.table_class, "average-albedo") << summary(verdict);
  EXPECT_LT(verdict.best.max_error, 1e-4) << summary(verdict);
}

}  // namespace
}  // namespace kiln

// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <numbers>

#include "kiln/math/hash.h"
#include "made_table.h"

namespace kiln {
namespace {

using test::make_table;
using test::summary;

NumberArray picture(int width, int height, int channels,
                    const std::function<double(double, double, int)>& value) {
  NumberArray array;
  array.shape = {height, width, channels};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (int c = 0; c < channels; ++c) {
        array.values.push_back(value((x + 0.5) / width, (y + 0.5) / height, c));
      }
    }
  }
  return array;
}

void expect_nothing(const NumberArray& array) {
  const Verdict verdict = verify_tables({array}, {.max_error = 1});
  EXPECT_FALSE(verdict.fits) << summary(verdict);
  EXPECT_FALSE(verdict.within);
  EXPECT_TRUE(verdict.presets.empty());
}

TEST(NoTables, ConstantsFitNothing) {
  for (const double level : {0.0, 0.5, 1.0}) {
    expect_nothing(picture(32, 32, 3, [&](double, double, int) { return level; }));
  }
}

TEST(NoTables, NoiseFitsNothing) {
  uint32_t seed = 0;
  expect_nothing(picture(64, 64, 2, [&](double, double, int) {
    return static_cast<double>(mix_bits(seed++ + 77)) / 4294967296.0;
  }));
}

TEST(NoTables, RampsFitNothing) {
  expect_nothing(picture(64, 64, 1, [](double x, double, int) { return x; }));
  expect_nothing(picture(64, 64, 2, [](double x, double y, int c) { return c == 0 ? x : y; }));
  expect_nothing(picture(64, 64, 1, [](double x, double y, int) { return x * y; }));
  expect_nothing(picture(64, 64, 1, [](double x, double y, int) { return 1 - x * y / 2; }));
}

TEST(NoTables, AFresnelRampWithoutRoughnessFitsNothing) {
  expect_nothing(picture(64, 64, 1, [](double x, double, int) { return std::pow(1 - x, 5); }));
}

TEST(NoTables, ToneCurvesAndVignettesFitNothing) {
  expect_nothing(picture(
      64, 64, 3, [](double x, double y, int c) { return std::pow(c == 0 ? x : y, 1 / 2.2); }));
  expect_nothing(picture(64, 64, 1, [](double x, double y, int) {
    return std::exp(-3 * ((x - 0.5) * (x - 0.5) + (y - 0.5) * (y - 0.5)));
  }));
}

TEST(NoTables, ANormalMapFitsNothing) {
  expect_nothing(picture(64, 64, 3, [](double x, double y, int c) {
    const double dx = 0.4 * std::cos(12 * x), dy = 0.4 * std::sin(9 * y);
    const double length = std::sqrt(dx * dx + dy * dy + 1);
    return 0.5 + 0.5 * (c == 0 ? dx : c == 1 ? dy : 1) / length;
  }));
}

TEST(NoTables, ScrambledRowsFitNothing) {
  NumberArray array = make_table({});
  const NumberArray whole = array;
  for (size_t y = 0; y < 32; ++y) {
    const size_t from = (y * 13 + 5) % 32;
    std::copy_n(whole.values.begin() + from * 64, 64, array.values.begin() + y * 64);
  }
  expect_nothing(array);
}

TEST(NoTables, OtherCurvesFitNothing) {
  const auto curve = [](const std::function<double(double)>& value) {
    NumberArray array;
    for (int i = 0; i < 64; ++i) array.values.push_back(value((i + 0.5) / 64));
    array.shape = {64};
    array.stored = NumberArray::Stored::Decimal;
    return array;
  };
  expect_nothing(curve([](double u) { return u; }));
  expect_nothing(curve([](double u) { return 1 - 0.6 * u * u; }));
  expect_nothing(curve([](double u) { return std::cos(1.15 * u); }));
  expect_nothing(curve([](double u) { return std::exp(-u); }));
}

TEST(NoTables, FewNumbersOrNoneFitNothing) {
  expect_nothing({});
  expect_nothing(picture(2, 2, 3, [](double x, double y, int) { return x + y; }));
  EXPECT_FALSE(verify_tables({}).fits);
}

}  // namespace
}  // namespace kiln

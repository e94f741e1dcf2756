// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <set>

#include "image_folder.h"

namespace kiln {
namespace {

using namespace test;
using testing::ElementsAre;
using testing::HasSubstr;

// Every value of an unsigned float with 5 bits of exponent over so many of mantissa.
std::set<double> small_floats(int mantissa_bits) {
  std::set<double> values;
  for (int exponent = 0; exponent < 31; ++exponent) {
    for (int mantissa = 0; mantissa < 1 << mantissa_bits; ++mantissa) {
      const double leading = exponent == 0 ? 0 : 1;
      values.insert(
          std::ldexp(leading + std::ldexp(mantissa, -mantissa_bits), std::max(exponent, 1) - 15));
    }
  }
  return values;
}

// One row of R, G, B, the same in all three.
Layers grey_row(const std::vector<float>& values) {
  Layers image = make_layers({static_cast<int>(values.size()), 1}, {"R", "G", "B"});
  for (Layer& layer : image.layers) std::copy(values.begin(), values.end(), layer.plane.row(0));
  return image;
}

std::vector<float> row_of(const Layers& image, const std::string& name) {
  const auto row = image.find(name)->texels_of_row(0);
  return {row.begin(), row.end()};
}

std::vector<float> random_values(size_t count, double least_log2, double most_log2) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> log2(least_log2, most_log2);
  std::vector<float> values(count);
  for (float& value : values) value = static_cast<float>(std::exp2(log2(random)));
  return values;
}

TEST(B10g11r11, HoldsEachOfItsValuesExactly) {
  for (const auto& [bits, name] : {std::pair{6, "R"}, std::pair{6, "G"}, std::pair{5, "B"}}) {
    const std::set<double> all = small_floats(bits);
    const std::vector<float> values(all.begin(), all.end());
    EXPECT_EQ(row_of(coded(grey_row(values), PixelType::B10g11r11), name), values) << name;
  }
}

TEST(B10g11r11, RoundsToTheNearestOfItsValues) {
  const std::vector<float> values = random_values(3000, -22, 15.9);
  const Layers result = coded(grey_row(values), PixelType::B10g11r11);
  for (const auto& [bits, name] : {std::pair{6, "R"}, std::pair{6, "G"}, std::pair{5, "B"}}) {
    const std::set<double> all = small_floats(bits);
    const std::vector<float> row = row_of(result, name);
    for (size_t i = 0; i < values.size(); ++i) {
      const auto above = all.lower_bound(values[i]);
      double nearest = above == all.end() ? *all.rbegin() : *above - values[i];
      if (above == all.end()) nearest = values[i] - *all.rbegin();
      if (above != all.end() && above != all.begin()) {
        nearest = std::min(nearest, values[i] - *std::prev(above));
      }
      ASSERT_EQ(std::abs(double(row[i]) - values[i]), nearest) << values[i] << " in " << name;
    }
  }
}

TEST(B10g11r11, RoundsTiesToEven) {
  const float step = 1.0f / 64;
  EXPECT_THAT(
      row_of(coded(grey_row({1 + step / 2, 1 + 3 * step / 2, 2 - step / 2}), PixelType::B10g11r11),
             "R"),
      ElementsAre(1.0f, 1 + 2 * step, 2.0f));
}

TEST(SmallTypes, ClampWhatTheyCannotHold) {
  constexpr float inf = std::numeric_limits<float>::infinity();
  const Layers image = grey_row({-1.0f, -inf, NAN, -0.0f, 1e6f, inf});
  const Layers floats = coded(image, PixelType::B10g11r11);
  EXPECT_THAT(row_of(floats, "R"), ElementsAre(0, 0, 0, 0, 65024, 65024));
  EXPECT_THAT(row_of(floats, "B"), ElementsAre(0, 0, 0, 0, 64512, 64512));
  const Layers shared = coded(image, PixelType::E5b9g9r9);
  EXPECT_THAT(row_of(shared, "G"), ElementsAre(0, 0, 0, 0, 65408, 65408));
  const Layers halves = coded(image, PixelType::Half);
  EXPECT_EQ(row_of(halves, "R")[4], 65504);
  EXPECT_FLOAT_EQ(row_of(coded(image, PixelType::Rgbd8), "R")[4], 255);
}

// With the exponent e the mantissas count steps of 2^(e - 24): they round to the nearest, and half
// of the step would not hold the largest.
TEST(E5b9g9r9, HasTheSmallestStepThatHoldsTheLargestOfThree) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> level(-30, 16), below(-12, 0);
  Layers image = make_layers({4000, 1}, {"R", "G", "B"});
  for (int x = 0; x < 4000; ++x) {
    const double largest = level(random);
    for (Layer& layer : image.layers) {
      layer.plane.at(x, 0) =
          static_cast<float>(std::min(65408.0, std::exp2(largest + below(random))));
    }
  }
  const Layers result = coded(image, PixelType::E5b9g9r9);
  for (int x = 0; x < 4000; ++x) {
    double largest = 0;
    for (const Layer& layer : image.layers)
      largest = std::max<double>(largest, layer.plane.at(x, 0));
    int exponent = 0;
    while (std::floor(std::ldexp(largest, 24 - exponent) + 0.5) > 511) ++exponent;
    ASSERT_LE(exponent, 31);
    const double step = std::ldexp(1.0, exponent - 24);
    for (size_t c = 0; c < 3; ++c) {
      const double value = image.layers[c].plane.at(x, 0), stored = result.layers[c].plane.at(x, 0);
      ASSERT_EQ(stored, std::floor(value / step + 0.5) * step) << value << " beside " << largest;
    }
  }
}

TEST(E5b9g9r9, TakesTheNextExponentWhenTheLargestRoundsUpToIt) {
  // 511.5 steps of 1/512 are 512, which needs the step 1/256.
  const Layers image = grey_row({511.5f / 512});
  EXPECT_THAT(row_of(coded(image, PixelType::E5b9g9r9), "R"), ElementsAre(1.0f));
}

TEST(Coded, IsWhatItWasWhereTheTypeIsExact) {
  const Layers image = pattern({7, 5}, {"R", "stderr.R", "A"});
  const Layers result = coded(image, PixelType::Float);
  EXPECT_EQ(channel_names(result), channel_names(image));
  for (size_t c = 0; c < 3; ++c) {
    EXPECT_THAT(
        std::vector<float>(result.layers[c].plane.row(4), result.layers[c].plane.row(4) + 7),
        testing::ElementsAreArray(image.layers[c].plane.row(4), 7));
  }
}

TEST(Coded, TakesBlueByItsName) {
  Layers image = make_layers({1, 1}, {"B", "G", "R"});
  for (Layer& layer : image.layers) layer.plane.at(0, 0) = 1 + 1.0f / 64;
  const Layers result = coded(image, PixelType::B10g11r11);
  EXPECT_EQ(result.find("B")->at(0, 0), 1);  // a tie, to even
  EXPECT_EQ(result.find("R")->at(0, 0), 1 + 1.0f / 64);
}

TEST(Coded, KeepsWithinHalfAStepOfRgbd) {
  const std::vector<float> values = random_values(2000, -8, 7.9);
  const std::vector<float> row = row_of(coded(grey_row(values), PixelType::Rgbd8), "R");
  for (size_t i = 0; i < values.size(); ++i) {
    const double a = std::floor(255 / std::max(values[i], 1.0f)) / 255;
    const double step = 2.2 / 255 * std::pow(values[i] * a + 0.01, 1.2 / 2.2) / a;
    ASSERT_NEAR(row[i], values[i], 0.55 * step);
  }
}

TEST(Coded, RefusesAlphaWhereATypeHasNone) {
  const Layers image = pattern({2, 2}, {"R", "G", "B", "A"});
  for (const PixelType type : {PixelType::B10g11r11, PixelType::E5b9g9r9, PixelType::Rgbd8}) {
    EXPECT_THAT(
        fault_text(Fault::Usage, [&] { coded(image, type); }),
        HasSubstr("found 4 channels; " + std::string(pixel_type_name(type)) + " holds 1 to 3"));
  }
  EXPECT_EQ(coded(image, PixelType::Rgb10a2).layers.size(), 4u);
}

}  // namespace
}  // namespace kiln

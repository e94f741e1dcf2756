// SPDX-License-Identifier: Apache-2.0
// The tables that Cycles publishes, made again by their conventions.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "kiln/table/lut.h"
#include "support/real_data.h"

namespace kiln {
namespace {

std::vector<double> read_numbers(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::vector<double> numbers;
  for (std::string line; std::getline(file, line);) {
    if (!line.empty() && line[0] != '#') numbers.push_back(std::stod(line));
  }
  return numbers;
}

std::vector<double> made(const std::string& table, const std::vector<std::string>& axes,
                         Size size) {
  TableRecipe recipe = recipe_of(find_table(table));
  recipe.axes = axes;
  recipe.alignment = Alignment::Corner;
  recipe.size = size;
  recipe.depth = 16;
  complete(recipe);
  return build_lut(recipe).entries.at(0);
}

struct Distance {
  double greatest = 0, rms = 0;
};

Distance distance(const std::vector<double>& a, const std::vector<double>& b) {
  Distance found;
  EXPECT_EQ(a.size(), b.size());
  for (size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    found.greatest = std::max(found.greatest, std::abs(a[i] - b[i]));
    found.rms += (a[i] - b[i]) * (a[i] - b[i]);
  }
  found.rms = std::sqrt(found.rms / static_cast<double>(a.size()));
  return found;
}

// Printed with six digits.
TEST(CyclesTables, AlbedosAgreeToTheDigitsPrinted) {
  KILN_REQUIRE_REAL_DATA(folder);
  const auto tables = folder / "data/reference";
  const Distance albedo = distance(read_numbers(tables / "cycles_table_ggx_E.txt"),
                                   made("directional-albedo", {"roughness", "mu"}, {32, 32}));
  EXPECT_LE(albedo.greatest, 1e-6);
  const Distance average = distance(read_numbers(tables / "cycles_table_ggx_Eavg.txt"),
                                    made("average-albedo", {"roughness"}, {32, 1}));
  EXPECT_LE(average.greatest, 1e-6);
}

// Random samples behind these: rms 1e-5 and 5e-5, the most at the last slice.
TEST(CyclesTables, SharesAgreeWithinTheirNoise) {
  KILN_REQUIRE_REAL_DATA(folder);
  const auto tables = folder / "data/reference";
  const Distance dielectric =
      distance(read_numbers(tables / "cycles_table_ggx_gen_schlick_ior_s.txt"),
               made("ior-share", {"roughness", "mu", "fourth-root-f0"}, {16, 16}));
  EXPECT_LE(dielectric.rms, 2e-5);
  EXPECT_LE(dielectric.greatest, 1e-3);
  const Distance schlick =
      distance(read_numbers(tables / "cycles_table_ggx_gen_schlick_s.txt"),
               made("schlick-share", {"roughness", "mu", "schlick-exponent"}, {16, 16}));
  EXPECT_LE(schlick.rms, 1e-4);
  EXPECT_LE(schlick.greatest, 3e-3);
}

}  // namespace
}  // namespace kiln

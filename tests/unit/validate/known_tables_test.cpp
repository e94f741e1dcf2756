// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "kiln/io/image_file.h"
#include "made_table.h"
#include "support/real_data.h"

namespace kiln {
namespace {

using test::summary;
using testing::Contains;
using testing::HasSubstr;
using testing::StartsWith;

NumberArray image(const std::filesystem::path& path) {
  const ImageFile file = read_image(path);
  NumberArray array;
  const Size size = file.image.size;
  array.shape = {size.height, size.width, static_cast<int>(file.image.layers.size())};
  array.stored = file.facts.type == PixelType::Uint8  ? NumberArray::Stored::Uint8
                 : file.facts.type == PixelType::Half ? NumberArray::Stored::Half
                                                      : NumberArray::Stored::Float;
  for (const Layer& layer : file.image.layers) array.channels.push_back(layer.name);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      for (const Layer& layer : file.image.layers) array.values.push_back(layer.plane.at(x, y));
    }
  }
  return array;
}

NumberArray lines(const std::filesystem::path& path) {
  std::ifstream file(path);
  NumberArray array;
  for (std::string line; std::getline(file, line);) {
    if (!line.empty() && line[0] != '#') array.values.push_back(std::stod(line));
  }
  array.shape = {static_cast<int>(array.values.size())};
  array.stored = NumberArray::Stored::Decimal;
  return array;
}

TEST(KnownTables, ThreeIsRecognised) {
  KILN_REQUIRE_REAL_DATA(data);
  const Verdict verdict =
      verify_tables({image(data / "data/reference/three_dfg_16_scale_bias.exr")});
  EXPECT_TRUE(verdict.fits) << summary(verdict);
  EXPECT_EQ(verdict.presets, std::vector<std::string>{"three"});
  EXPECT_LT(verdict.best.max_error, 0.0146);
  EXPECT_LT(verdict.best.channels[1].max_error, 7e-4);
  EXPECT_GT(verdict.ratio, 5) << summary(verdict);
}

TEST(KnownTables, CyclesIsRecognisedToItsLastDigit) {
  KILN_REQUIRE_REAL_DATA(data);
  const Verdict verdict = verify_tables({lines(data / "data/reference/cycles_table_ggx_E.txt")});
  EXPECT_TRUE(verdict.fits) << summary(verdict);
  EXPECT_EQ(verdict.presets, std::vector<std::string>{"cycles"});
  EXPECT_LT(verdict.best.max_error, 1.1e-6) << summary(verdict);
  const Verdict average = verify_tables({lines(data / "data/reference/cycles_table_ggx_Eavg.txt")});
  EXPECT_TRUE(average.fits) << summary(average);
  EXPECT_EQ(average.best.table_class, "average-albedo");
  EXPECT_LT(average.best.max_error, 1e-6) << summary(average);
}

TEST(KnownTables, FilamentIsRecognisedWithItsShiftedRows) {
  KILN_REQUIRE_REAL_DATA(data);
  const std::filesystem::path folder = data / "data/reference/filament_cmgen";
  const std::vector<std::pair<std::string, std::string>> tables{
      {"dfg_singlescatter_128.exr", "filament"},
      {"dfg_multiscatter_128.exr", "filament-multiscatter"}};
  for (const auto& [name, preset] : tables) {
    const Verdict verdict = verify_tables({image(folder / name)});
    EXPECT_TRUE(verdict.fits) << summary(verdict);
    EXPECT_EQ(verdict.presets, std::vector<std::string>{preset});
    EXPECT_LT(verdict.best.max_error, 0.015) << summary(verdict);
    EXPECT_THAT(verdict.statements,
                Contains(StartsWith("rows hold the roughness of the next row")));
    EXPECT_THAT(verdict.statements, Contains(HasSubstr("about 1024 samples")));
  }
}

TEST(KnownTables, ClothBesideFilamentsTableIsRecognised) {
  KILN_REQUIRE_REAL_DATA(data);
  const Verdict verdict =
      verify_tables({image(data / "data/reference/filament_cmgen/dfg_multiscatter_cloth_128.exr")});
  EXPECT_TRUE(verdict.fits) << summary(verdict);
  EXPECT_EQ(verdict.best.channels[2].distribution, "charlie") << summary(verdict);
  EXPECT_THAT(verdict.presets, Contains("filament-cloth"));
  EXPECT_THAT(verdict.statements, Contains(StartsWith("rows hold the roughness of the next row")));
}

TEST(KnownTables, AlbedosOfLinearlyTransformedCosinesAreRecognised) {
  KILN_REQUIRE_REAL_DATA(data);
  const Verdict verdict = verify_tables({image(data / "data/reference/three_ltc_mat_2_64.exr")});
  EXPECT_TRUE(verdict.fits) << summary(verdict);
  EXPECT_EQ(verdict.presets, std::vector<std::string>{"ltc"});
  EXPECT_THAT(verdict.best.channels[3].quantity, HasSubstr("form factor of a sphere"));
  EXPECT_LT(verdict.best.channels[3].max_error, 1e-5);
}

// 0.062 on average and 0.31 at most, with the exact lobe.
TEST(KnownTables, MatricesOfLinearlyTransformedCosinesAreKnownByTheirLobes) {
  KILN_REQUIRE_REAL_DATA(data);
  const Verdict verdict = verify_tables({image(data / "data/reference/three_ltc_mat_1_64.exr")});
  EXPECT_TRUE(verdict.fits) << summary(verdict);
  EXPECT_EQ(verdict.best.table_class, "ltc");
  EXPECT_EQ(verdict.presets, std::vector<std::string>{"ltc"});
  EXPECT_GT(verdict.ratio, 1.5) << summary(verdict);
}

TEST(KnownTables, GlassOfCyclesIsRecognisedOnBothSides) {
  KILN_REQUIRE_REAL_DATA(data);
  const Verdict enter =
      verify_tables({lines(data / "data/reference/cycles_table_ggx_glass_E.txt")});
  const Verdict leave =
      verify_tables({lines(data / "data/reference/cycles_table_ggx_glass_inv_E.txt")});
  for (const Verdict* verdict : {&enter, &leave}) {
    EXPECT_TRUE(verdict->fits) << summary(*verdict);
    EXPECT_EQ(verdict->best.table_class, "glass");
    EXPECT_EQ(verdict->presets, std::vector<std::string>{"cycles"});
  }
  EXPECT_THAT(leave.best.channels[0].quantity, HasSubstr("turned back by refraction"));
}

TEST(KnownTables, PhotographsAndNormalMapsAreNone) {
  KILN_REQUIRE_REAL_DATA(data);
  for (const char* name :
       {"data/reference/oiio_normal_src.exr", "data/reference/oiio_bumpslope.exr",
        "data/reference/filament_cmgen/venice_sunset_prefilter_m0.exr"}) {
    const Verdict verdict = verify_tables({image(data / name)});
    EXPECT_FALSE(verdict.fits) << name << ": " << summary(verdict);
  }
}

}  // namespace
}  // namespace kiln

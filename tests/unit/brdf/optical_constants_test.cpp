// SPDX-License-Identifier: Apache-2.0
#include "kiln/brdf/optical_constants.h"

#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <sstream>

#include "support/faults.h"
#include "support/real_data.h"

namespace kiln {
namespace {

using Constants = std::vector<OpticalConstant>;

// The rows of one material: material,quantity,lambda_nm,value with quantity eta or k.
Constants read_material(const std::filesystem::path& path, const std::string& wanted) {
  std::map<double, OpticalConstant> constants;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    std::stringstream cells(line);
    std::string material, quantity, nm, value;
    std::getline(cells, material, ',');
    std::getline(cells, quantity, ',');
    std::getline(cells, nm, ',');
    std::getline(cells, value, ',');
    if (material != wanted) continue;
    OpticalConstant& at = constants[std::stod(nm)];
    at.wavelength_nm = std::stod(nm);
    (quantity == "eta" ? at.n : at.k) = std::stod(value);
  }
  Constants list;
  list.reserve(constants.size());
  for (const auto& [nm, constant] : constants) list.push_back(constant);
  return list;
}

TEST(OpticalConstants, ThatDoNotVaryGiveAGrayOfTheirReflectance) {
  const Constants flat = {{400, 1.5, 0}, {700, 1.5, 0}};
  const Vec3<double> color = optical_constants_to_rgb(flat);
  EXPECT_NEAR(color.x, 0.04, 1e-12);
  EXPECT_NEAR(color.y, 0.04, 1e-12);
  EXPECT_NEAR(color.z, 0.04, 1e-12);
}

TEST(OpticalConstants, AtGrazingIncidenceGiveWhite) {
  const Constants varied = {{400, 0.2, 2}, {700, 1.5, 4}};
  EXPECT_NEAR(optical_constants_to_rgb(varied, 0).y, 1, 1e-6);
}

TEST(OpticalConstants, ThatReflectLongWavelengthsMoreAreReddish) {
  const Constants reddish = {{400, 1.5, 0}, {700, 0.2, 4}};
  const Vec3<double> color = optical_constants_to_rgb(reddish);
  EXPECT_GT(color.x, color.y);
  EXPECT_GT(color.y, color.z);
}

TEST(OpticalConstants, OfKnownMetalsGiveTheirPublishedColours) {
  KILN_REQUIRE_REAL_DATA(folder);
  const auto path = folder / "data/reference/pbrt_optical_constants.csv";
  // Linear F0 as widely published for real-time rendering.
  const std::map<std::string, Vec3<double>> published = {{"Au", {1.00, 0.77, 0.34}},
                                                         {"Ag", {0.97, 0.96, 0.92}},
                                                         {"Cu", {0.96, 0.64, 0.54}},
                                                         {"Al", {0.91, 0.92, 0.92}}};
  for (const auto& [metal, color] : published) {
    const Vec3<double> found = optical_constants_to_rgb(read_material(path, metal));
    EXPECT_NEAR(found.x, color.x, 0.03) << metal;
    EXPECT_NEAR(found.y, color.y, 0.03) << metal;
    EXPECT_NEAR(found.z, color.z, 0.03) << metal;
  }
}

TEST(OpticalConstants, WithoutSamplesOrInDisorderAreRefused) {
  test::fault_text(Fault::Input, [] { optical_constants_to_rgb(Constants{}); });
  const std::string text = test::fault_text(Fault::Input, [] {
    optical_constants_to_rgb(Constants{{500, 1, 1}, {400, 1, 1}});
  });
  EXPECT_NE(text.find("400 nm after 500 nm"), std::string::npos) << text;
}

}  // namespace
}  // namespace kiln

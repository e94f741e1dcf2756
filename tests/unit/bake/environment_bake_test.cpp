// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <functional>
#include <nlohmann/json.hpp>

#include "support/scenes.h"

namespace kiln {
namespace {

Baked bake_sphere(const SphereImage& sphere, const test::Settings& settings,
                  const LightSettings& light = {}) {
  const auto recipe = make_recipe("environment");
  for (const auto& [name, value] : settings) recipe->set(name, value);
  const LightMade made = make_light(sphere, light);
  Ingredients ingredients;
  ingredients.light = made.light.get();
  return recipe->bake(ingredients);
}

Baked bake_environment(const Layers& latlong, const test::Settings& settings) {
  return bake_sphere(latlong_image(latlong), settings);
}

/// A cube whose texels hold a function of direction, grey.
SphereImage make_cube(int n, const std::function<double(const Vec3<double>&)>& radiance) {
  SphereImage cube = cube_image(std::vector<Layers>(6, make_layers({n, n}, {"R", "G", "B"})));
  for (size_t face = 0; face < 6; ++face) {
    for (int y = 0; y < n; ++y) {
      for (int x = 0; x < n; ++x) {
        const Vec3<double> d = sample_direction(cube, static_cast<int>(face), x, y);
        for (Layer& layer : cube.images[face].layers) {
          layer.plane.at(x, y) = static_cast<float>(radiance(d));
        }
      }
    }
  }
  return cube;
}

double sky_and_sun(const Vec3<double>& d) {
  return (d.y > 0 ? 1 + d.y : 0.2) + (dot(d, normalize(Vec3<double>{1, 2, 3})) > 0.99 ? 500 : 0);
}

const Artifact& find(const Baked& baked, const std::string& name) {
  for (const Artifact& artifact : baked.artifacts) {
    if (artifact.name == name) return artifact;
  }
  throw Error(Fault::Internal, "no artifact '" + name + "'");
}

TEST(EnvironmentBake, OfAConstantIsThatConstantEverywhere) {
  const Layers room = test::constant_latlong(0.75);
  for (const char* layout : {"cube", "latlong"}) {
    const Baked baked = bake_environment(room, {{"size", "32"}, {"layout", layout}});
    for (const Artifact& artifact : baked.artifacts) {
      for (const Layer& layer : artifact.image.layers) {
        for (int y = 0; y < layer.plane.height(); ++y) {
          for (const float value : layer.plane.texels_of_row(y)) {
            EXPECT_NEAR(value, 0.75, 2e-5) << artifact.name;
          }
        }
      }
    }
  }
}

TEST(EnvironmentBake, NamesFacesAndLevelsAndDescribesThem) {
  const Baked baked = bake_environment(test::constant_latlong(1), {{"size", "64"}});
  EXPECT_EQ(find(baked, "specular_m0_px").image.size, (Size{64, 64}));
  EXPECT_EQ(find(baked, "specular_m2_nz").image.size, (Size{16, 16}));
  EXPECT_EQ(find(baked, "irradiance_py").image.size, (Size{64, 64}));
  const auto env = nlohmann::json::parse(find(baked, "env").text);
  EXPECT_EQ(env["curve"], "filament");
  EXPECT_EQ(env["layout"], "cube");
  EXPECT_EQ(env["roughness"].size(), 3u);
  EXPECT_EQ(env["roughness"][0], 0.0);
  EXPECT_EQ(env["roughness"][2], 1.0);
  const auto sh = nlohmann::json::parse(find(baked, "sh").text);
  EXPECT_EQ(sh["radiance"].size(), 9u);
  EXPECT_NEAR(sh["radiance"][0][0], 2 * std::sqrt(pi), 1e-5);
  EXPECT_NEAR(double(sh["irradiance_over_pi"][0][0]) / (2 * std::sqrt(pi)), 1, 1e-5);
}

TEST(EnvironmentBake, PutsTheSkyOnTheUpperFace) {
  const Layers sky =
      test::make_latlong({128, 64}, [](const Vec3<double>& d) { return d.y > 0 ? 2.0 : 0.1; });
  const Baked baked = bake_environment(sky, {{"size", "32"}});
  EXPECT_NEAR(find(baked, "specular_m0_py").image.layers[0].plane.at(16, 16), 2, 1e-3);
  EXPECT_NEAR(find(baked, "specular_m0_ny").image.layers[0].plane.at(16, 16), 0.1, 1e-3);
  EXPECT_GT(find(baked, "irradiance_px").image.layers[0].plane.at(32, 8),
            find(baked, "irradiance_px").image.layers[0].plane.at(32, 56));
}

TEST(EnvironmentBake, CountsAndRepairsWhatIsNotFinite) {
  Layers latlong = test::constant_latlong(1);
  latlong.layers[0].plane.at(5, 5) = NAN;
  latlong.layers[1].plane.at(6, 5) = INFINITY;
  latlong.layers[2].plane.at(7, 5) = -2;
  const auto env =
      nlohmann::json::parse(find(bake_environment(latlong, {{"size", "16"}}), "env").text);
  EXPECT_EQ(env["fixed"]["nan"], 1);
  EXPECT_EQ(env["fixed"]["inf"], 1);
  EXPECT_EQ(env["fixed"]["negative"], 1);
}

TEST(EnvironmentBake, OfAConstantCubeIsThatConstantEverywhere) {
  const SphereImage room = make_cube(24, [](const Vec3<double>&) { return 0.75; });
  for (const char* layout : {"cube", "latlong", "octahedral"}) {
    for (const Artifact& artifact :
         bake_sphere(room, {{"size", "32"}, {"layout", layout}}).artifacts) {
      for (const Layer& layer : artifact.image.layers) {
        for (int y = 0; y < layer.plane.height(); ++y) {
          for (const float value : layer.plane.texels_of_row(y)) {
            ASSERT_NEAR(value, 0.75, 2e-5) << artifact.name << " " << layout;
          }
        }
      }
    }
  }
}

// Narrow lobes would see single texels of a coarse cube, with nothing in between.
TEST(EnvironmentBake, OfACubeErrsAsLittleAsOfALatLongImageHoweverCoarseItIs) {
  for (const int n : {4, 16, 48}) {
    const Baked baked = bake_sphere(make_cube(n, sky_and_sun), {{"size", "128"}});
    const auto env = nlohmann::json::parse(find(baked, "env").text);
    for (const double error : env["error"]["levels"]) EXPECT_LT(error, 5e-4) << n;
    EXPECT_LT(env["error"]["irradiance"], 2e-4) << n;
  }
}

TEST(EnvironmentBake, OfACubeOfTheSameSizeKeepsItsTexels) {
  const SphereImage cube = make_cube(32, sky_and_sun);
  const Baked baked = bake_sphere(cube, {{"size", "32"}});
  for (size_t face = 0; face < 6; ++face) {
    const Layers& image = find(baked, "specular_m0_" + std::string(cube_face_names[face])).image;
    for (int y = 0; y < 32; ++y) {
      for (int x = 0; x < 32; ++x) {
        ASSERT_EQ(image.layers[0].plane.at(x, y), cube.images[face].layers[0].plane.at(x, y));
      }
    }
  }
}

TEST(EnvironmentBake, TurnsPlusZTowardPlusX) {
  const auto ahead = [](const Vec3<double>& d) { return d.z > 0.9 ? 10.0 : 0.1; };
  LightSettings turned;
  turned.rotate_deg = 90;
  for (const SphereImage& sphere :
       {make_cube(32, ahead), latlong_image(test::make_latlong({128, 64}, ahead))}) {
    const Baked baked = bake_sphere(sphere, {{"size", "32"}}, turned);
    EXPECT_NEAR(find(baked, "specular_m0_px").image.layers[0].plane.at(16, 16), 10, 0.5);
    EXPECT_NEAR(find(baked, "specular_m0_pz").image.layers[0].plane.at(16, 16), 0.1, 1e-2);
    EXPECT_GT(find(baked, "irradiance_px").image.layers[0].plane.at(32, 32),
              3 * find(baked, "irradiance_pz").image.layers[0].plane.at(32, 32));
  }
}

}  // namespace
}  // namespace kiln

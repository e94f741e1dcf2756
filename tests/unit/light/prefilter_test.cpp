// SPDX-License-Identifier: Apache-2.0
#include "kiln/light/prefilter.h"

#include <gtest/gtest.h>

#include "brute_force.h"
#include "finer.h"
#include "kiln/brdf/models.h"
#include "kiln/core/error.h"
#include "kiln/light/filter_error.h"
#include "kiln/light/source.h"

namespace kiln {
namespace {

using test::BruteForce;
using test::LevelError;

void expect_levels_near_brute_force(const Layers& image, const Layers& truth_image, int size) {
  const SpecularChain chain(image, {.size = size});
  const BruteForce truth(truth_image);
  const Vec3<double> mean = mean_radiance(truth_image);
  for (int level = 1; level < chain.levels(); ++level) {
    const auto probed = test::probe(chain.size(level), 200, test::brightest_direction(truth_image));
    const LevelError random = test::error_of(chain, level, truth, mean, probed.random);
    const LevelError near = test::error_of(chain, level, truth, mean, probed.near);
    EXPECT_LT(random.rms, 2e-5) << "level " << level;
    EXPECT_LT(random.max, 2e-4) << "level " << level;
    EXPECT_LT(near.max, 2e-3) << "level " << level;
  }
}

TEST(Prefilter, IsNearBruteForceAroundASunAndElsewhere) {
  const Layers image = test::sunny_environment({256, 128}, 1e4);
  expect_levels_near_brute_force(image, image, 64);
}

TEST(Prefilter, IsNearBruteForceForSizesThatAreNoPowersOfTwo) {
  const Layers image = test::sunny_environment({250, 127}, 300);
  expect_levels_near_brute_force(image, image, 48);
}

TEST(Prefilter, FirstMakesACoarseSourceFinerForASharpLobe) {
  const Layers image = test::sunny_environment({32, 16}, 30);
  const FilterLobe sharp{.alpha = 0.02};
  const Refinement times = refinement_for(image.size, 300);
  EXPECT_GE(32 * times.across, 301);
  const std::vector<Vec3<double>> directions = {test::random_direction(0, 1),
                                                test::brightest_direction(image)};
  const Layers finer_image = finer(image, {16, 16});
  const Prefilter coarse(image, {sharp}), fine(finer_image, {sharp});
  const auto a = coarse.brute_force({{sharp, directions}}),
             b = fine.brute_force({{sharp, directions}});
  for (size_t i = 0; i < 2; ++i) EXPECT_NEAR(a[0][i].x, b[0][i].x, 5e-3 * b[0][i].x);
  const FilteredLevel level{
      sharp, {SphereLayout::Cube, 64}, coarse.filter(sharp, {SphereLayout::Cube, 64})};
  EXPECT_LT(filter_errors(coarse, {level}, mean_radiance(image).y)[0].rms, 1e-4);
}

TEST(Prefilter, FiltersWithEveryListedDistribution) {
  const Layers image = test::sunny_environment({256, 128}, 1e3);
  const double mean = mean_radiance(image).y;
  for (const std::string& name : model_names("distribution")) {
    for (const double alpha : {0.1, 0.6}) {
      const FilterLobe lobe{name, alpha};
      const Prefilter prefilter(image, {lobe});
      const FilteredLevel level{
          lobe, {SphereLayout::Cube, 32}, prefilter.filter(lobe, {SphereLayout::Cube, 32})};
      const FilterError error = filter_errors(prefilter, {level}, mean)[0];
      EXPECT_LT(error.rms, 1e-4) << name << " " << alpha;
      EXPECT_LT(error.max, 1e-3) << name << " " << alpha;
      EXPECT_GT(error.max, 0) << name << " " << alpha;
    }
  }
}

TEST(Prefilter, IsTheSameFunctionInEveryLayout) {
  const Layers image = test::sunny_environment({256, 128}, 100);
  const FilterLobe lobe{.alpha = 0.2};
  const Prefilter prefilter(image, {lobe});
  for (const SphereLayout layout :
       {SphereLayout::Cube, SphereLayout::LatLong, SphereLayout::Octahedral}) {
    for (const bool at_nodes : {false, true}) {
      const SphereGrid grid{layout, 16, at_nodes};
      const FilteredLevel level{lobe, grid, prefilter.filter(lobe, grid)};
      EXPECT_LT(filter_errors(prefilter, {level}, mean_radiance(image).y)[0].max, 1e-4);
    }
  }
}

TEST(Prefilter, KeepsTheMeanOverTheSphereOfWideLobes) {
  // The mean of the exact convolution is that of the source: its kernel has integral 1.
  const Layers image = test::sunny_environment({256, 128}, 1e4);
  const double mean = mean_radiance(image).y;
  for (const double alpha : {0.09, 0.25, 1.0}) {
    const FilterLobe lobe{.alpha = alpha};
    const auto latlong = Prefilter(image, {lobe}).filter(lobe, {SphereLayout::LatLong, 64});
    EXPECT_NEAR(mean_radiance(latlong[0]).y, mean, 1e-4 * mean) << alpha;
  }
}

TEST(Prefilter, OfTheWidestLobeIsIrradianceOverPi) {
  const Layers image = test::sunny_environment({256, 128}, 100);
  const FilterLobe cosine{.alpha = 1};
  const auto faces = Prefilter(image, {cosine}).filter(cosine, {SphereLayout::Cube, 8});
  for (int face = 0; face < 6; ++face) {
    const Vec3<double> n =
        normalize(cube_to_direction(static_cast<CubeFace>(face), {3.5 / 8, 5.5 / 8}));
    const double expected = normalised_irradiance(image, std::vector{n})[0].y;
    EXPECT_NEAR(faces[static_cast<size_t>(face)].layers[1].plane.at(3, 5), expected,
                2e-4 * mean_radiance(image).y);
  }
}

TEST(Prefilter, RefusesLobesTooNarrowForIt) {
  const Layers white = test::constant_environment({16, 8}, 1);
  EXPECT_THROW(Prefilter(white, {{.alpha = 0.001}}), Error);
  EXPECT_THROW(Prefilter(white, {{.distribution = "gxg", .alpha = 0.5}}), Error);
}

TEST(Prefilter, LeavesNoUndershootInTheDark) {
  const Layers image = test::environment_of({256, 128}, [](const Vec3<double>& d) {
    const double value = d.x > 0.9995 ? 1e4 : 0;
    return Vec3<double>{value, value, value};
  });
  const SpecularChain chain(image, {.size = 64});
  for (int level = 0; level < chain.levels(); ++level) {
    for (int face = 0; face < 6; ++face) {
      const Layers texels = chain.face(level, static_cast<CubeFace>(face));
      for (int y = 0; y < chain.size(level); ++y) {
        for (float value : texels.layers[0].plane.texels_of_row(y)) ASSERT_GE(value, 0);
      }
    }
  }
}

TEST(Prefilter, KeepsNegativeRadianceLinear) {
  const Layers image = test::environment_of({128, 64}, [](const Vec3<double>& d) {
    return Vec3<double>{d.x, 1 + d.x, 1 - d.x};
  });
  const SpecularChain chain(image, {.size = 32});
  for (int face = 0; face < 6; ++face) {
    const Layers texels = chain.face(1, static_cast<CubeFace>(face));
    for (int y = 0; y < 16; ++y) {
      for (int x = 0; x < 16; ++x) {
        ASSERT_NEAR(texels.layers[0].plane.at(x, y) + 1, texels.layers[1].plane.at(x, y), 1e-5);
        ASSERT_NEAR(1 - texels.layers[0].plane.at(x, y), texels.layers[2].plane.at(x, y), 1e-5);
      }
    }
  }
}

TEST(Prefilter, ShowsTheTurnedEnvironmentInATurnedGrid) {
  // What was at +Z is seen at +X: that face is the other, texel for texel.
  const Layers image = test::sunny_environment({256, 128}, 100);
  const FilterLobe lobe{.alpha = 0.1};
  const Prefilter prefilter(image, {lobe});
  const auto filtered = [&](double rotate_deg) {
    return prefilter.filter(lobe, {.size = 16, .rotate_deg = rotate_deg});
  };
  const auto averaged = [&](double rotate_deg) {
    return average_over_texels(image, {.size = 16, .rotate_deg = rotate_deg});
  };
  const auto expect_turned = [](const std::vector<Layers>& still,
                                const std::vector<Layers>& turned) {
    const Plane& was = still[static_cast<size_t>(CubeFace::pz)].layers[0].plane;
    const Plane& is = turned[static_cast<size_t>(CubeFace::px)].layers[0].plane;
    for (int y = 0; y < 16; ++y) {
      for (int x = 0; x < 16; ++x) ASSERT_NEAR(is.at(x, y), was.at(x, y), 1e-4 * was.at(x, y));
    }
  };
  expect_turned(filtered(0), filtered(90));
  expect_turned(averaged(0), averaged(90));
}

TEST(Prefilter, OfACubesPointMassesIsNearItsOwnTexelsByBruteForce) {
  std::vector<Layers> faces;
  for (int face = 0; face < 6; ++face) {
    faces.push_back(make_layers({32, 32}, {"R", "G", "B"}));
    for (Layer& layer : faces.back().layers) {
      for (int k = 0; k < 32 * 32; ++k) {
        layer.plane.at(k % 32, k / 32) =
            static_cast<float>(test::random_unit(9, static_cast<std::uint32_t>(1024 * face + k)) +
                               (k == 300 ? 50 : 0));
      }
    }
  }
  const Layers masses = point_masses_of(cube_image(faces));
  const FilterLobe lobe{.alpha = 0.3};
  const auto found = Prefilter(masses, {lobe}).filter(lobe, {.size = 8});
  for (int face = 0; face < 6; ++face) {
    const Vec3<double> d = direction_of(SphereLayout::Cube, face, {2.5 / 8, 5.5 / 8});
    double sum = 0, weights = 0;
    for (int k = 0; k < 6 * 1024; ++k) {
      const int x = k % 32, y = k / 32 % 32, from = k / 1024;
      const Vec3<double> w =
          direction_of(SphereLayout::Cube, from, {(x + 0.5) / 32, (y + 0.5) / 32});
      const double weight = lobe_at(Ggx<double>::isotropic(lobe.alpha), dot(d - w, d - w) / 4) *
                            cube_texel_solid_angle(32, x, y);
      sum += weight * faces[static_cast<size_t>(from)].layers[0].plane.at(x, y);
      weights += weight;
    }
    EXPECT_NEAR(found[static_cast<size_t>(face)].layers[0].plane.at(2, 5), sum / weights,
                2e-4 * sum / weights);
  }
}

TEST(Prefilter, KeepsTheConstantOfACubesPointMasses) {
  std::vector<Layers> faces(6, make_layers({24, 24}, {"R", "G", "B"}));
  for (Layers& face : faces) {
    for (Layer& layer : face.layers) layer.plane = Plane(face.size, 0.7f);
  }
  const Layers masses = point_masses_of(cube_image(faces));
  const FilterLobe sharp{.alpha = 0.05}, wide{.alpha = 1};
  const Prefilter prefilter(masses, {sharp, wide});
  for (const FilterLobe& lobe : {sharp, wide}) {
    for (const Layers& image : prefilter.filter(lobe, {.size = 16})) {
      for (int y = 0; y < 16; ++y) {
        for (const float value : image.layers[2].plane.texels_of_row(y)) {
          ASSERT_NEAR(value, 0.7, 2e-6);
        }
      }
    }
  }
}

}  // namespace
}  // namespace kiln

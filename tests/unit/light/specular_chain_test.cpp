// SPDX-License-Identifier: Apache-2.0
#include "kiln/light/specular_chain.h"

#include <gtest/gtest.h>

#include <limits>

#include "kiln/core/error.h"
#include "kiln/light/irradiance.h"
#include "kiln/parallel/threads.h"
#include "synthetic.h"

namespace kiln {
namespace {

using test::random_direction;

constexpr std::array<CubeFace, 6> faces = {CubeFace::px, CubeFace::nx, CubeFace::py,
                                           CubeFace::ny, CubeFace::pz, CubeFace::nz};

double middle_of(const SpecularChain& chain, int level, CubeFace face) {
  const int middle = chain.size(level) / 2;
  return chain.face(level, face).layers[0].plane.at(middle, middle);
}

Vec3<double> axis_of(CubeFace face) { return cube_to_direction(face, {0.5, 0.5}); }

TEST(SpecularChain, HalvesItsSizesDownToSixteen) {
  const SpecularChain chain(test::constant_environment({64, 32}, 1), {.size = 128});
  ASSERT_EQ(chain.levels(), 4);
  EXPECT_EQ(chain.size(0), 128);
  EXPECT_EQ(chain.size(3), 16);
  EXPECT_EQ(SpecularChain(test::constant_environment({8, 4}, 1), {.size = 7}).levels(), 1);
}

TEST(SpecularChain, NamesTheRoughnessOfEachLevel) {
  const SpecularChain chain(test::constant_environment({16, 8}, 1), {.size = 64});
  EXPECT_EQ(chain.roughness(0), 0);
  EXPECT_NEAR(chain.roughness(1), 1 - std::sqrt(0.5), 1e-15);
  EXPECT_EQ(chain.roughness(2), 1);
  for (int level = 0; level < 3; ++level) {
    EXPECT_NEAR(chain_position(chain.roughness(level)), level / 2.0, 1e-15);
  }
}

TEST(SpecularChain, KeepsAConstantEnvironment) {
  for (const Size size : {Size{256, 128}, Size{64, 32}, Size{63, 31}}) {
    const SpecularChain chain(test::constant_environment(size, 0.7), {.size = 64});
    for (int level = 0; level < chain.levels(); ++level) {
      for (const CubeFace face : faces) {
        const Layers image = chain.face(level, face);
        for (int y = 0; y < chain.size(level); ++y) {
          for (int x = 0; x < chain.size(level); ++x) {
            ASSERT_NEAR(image.layers[0].plane.at(x, y), 0.7, 1e-6) << level;
          }
        }
      }
    }
  }
}

TEST(SpecularChain, ShowsLightFromAnAxisOnThatFace) {
  for (const CubeFace bright : faces) {
    const Layers image = test::environment_of({128, 64}, [&](const Vec3<double>& d) {
      const double value = dot(d, axis_of(bright)) > 0.99 ? 100 : 0.1;
      return Vec3<double>{value, value, value};
    });
    const SpecularChain chain(image, {.size = 64});
    for (int level = 0; level < chain.levels(); ++level) {
      for (const CubeFace other : faces) {
        if (other == bright) continue;
        EXPECT_GT(middle_of(chain, level, bright), 2 * middle_of(chain, level, other)) << level;
      }
    }
  }
}

TEST(SpecularChain, StoresEachTexelInTheDirectionOfItsFacePoint) {
  const Layers image = test::environment_of({256, 128}, [](const Vec3<double>& d) {
    return Vec3<double>{2 + d.x, 2 + d.y, 2 + d.z};
  });
  const SpecularChain chain(image, {.size = 32});
  for (const CubeFace face : faces) {
    const Layers texels = chain.face(0, face);
    for (int y = 0; y < 32; ++y) {
      for (int x = 0; x < 32; ++x) {
        const Vec3<double> d = normalize(cube_to_direction(face, {(x + 0.5) / 32, (y + 0.5) / 32}));
        ASSERT_NEAR(texels.layers[0].plane.at(x, y), 2 + d.x, 3e-3);
        ASSERT_NEAR(texels.layers[1].plane.at(x, y), 2 + d.y, 3e-3);
        ASSERT_NEAR(texels.layers[2].plane.at(x, y), 2 + d.z, 3e-3);
      }
    }
  }
}

TEST(SpecularChain, KeepsTheMeanRadianceInItsFirstLevel) {
  const Layers image = test::sunny_environment({256, 128}, 1e3);
  const SpecularChain chain(image, {.size = 32});
  double sum = 0;
  for (const CubeFace face : faces) {
    const Layers texels = chain.face(0, face);
    for (int y = 0; y < 32; ++y) {
      for (int x = 0; x < 32; ++x) {
        sum += texels.layers[1].plane.at(x, y) * cube_texel_solid_angle(32, x, y);
      }
    }
  }
  const double mean = mean_radiance(image).y;
  EXPECT_NEAR(sum / (4 * pi), mean, 1e-4 * mean);
}

/// Both sides of a point on the edge between two faces, a hair apart.
std::array<Vec3<double>, 2> across_edge(int axis, double sign_a, double sign_b, double along) {
  constexpr double hair = 1e-9;
  const auto direction = [&](double a, double b) {
    if (axis == 0) return normalize(Vec3<double>{along, a * sign_a, b * sign_b});
    if (axis == 1) return normalize(Vec3<double>{a * sign_a, along, b * sign_b});
    return normalize(Vec3<double>{a * sign_a, b * sign_b, along});
  };
  return {direction(1, 1 - hair), direction(1 - hair, 1)};
}

TEST(SpecularChain, HasNoSeamOnAnyOfTheTwelveEdges) {
  const Layers image = test::sunny_environment({128, 64}, 1e4);
  const SpecularChain chain(image, {.size = 64});
  const double mean = mean_radiance(image).x;
  for (int level = 0; level < chain.levels(); ++level) {
    for (int edge = 0; edge < 12; ++edge) {
      for (int i = 0; i <= 200; ++i) {
        const auto [a, b] = across_edge(edge / 4, edge % 2 ? 1 : -1, edge / 2 % 2 ? 1 : -1,
                                        (i - 100) / 100.0 * 0.9999999);
        const double here = chain.lookup_level(a, level).x, there = chain.lookup_level(b, level).x;
        ASSERT_NEAR(here, there, 2e-6 * (mean + here)) << "edge " << edge << ", level " << level;
      }
    }
  }
}

TEST(SpecularChainLookup, ReturnsATexelAtItsCentre) {
  const SpecularChain chain(test::sunny_environment({128, 64}, 100), {.size = 32});
  for (int level = 0; level < chain.levels(); ++level) {
    const int size = chain.size(level);
    for (const CubeFace face : faces) {
      const Layers texels = chain.face(level, face);
      for (int i = 0; i < size; ++i) {
        const int x = i, y = (7 * i + 3) % size;
        const Vec3<double> d = cube_to_direction(face, {(x + 0.5) / size, (y + 0.5) / size});
        const double found = chain.lookup(normalize(d), chain.roughness(level)).y;
        EXPECT_NEAR(found, texels.layers[1].plane.at(x, y), 1e-5 * (1 + found));
      }
    }
  }
}

TEST(SpecularChainLookup, BlendsTheLevelsByRoughness) {
  const SpecularChain chain(test::sunny_environment({128, 64}, 100), {.size = 32});
  const Vec3<double> d = random_direction(0, 1);
  const double a = chain.lookup_level(d, 0).x, b = chain.lookup_level(d, 1).x;
  EXPECT_NEAR(chain.lookup(d, 0.25).x, lerp(a, b, 0.25 * 1.75), 1e-6);
  EXPECT_EQ(chain.lookup(d, 0.0).x, a);
  EXPECT_EQ(chain.lookup(d, 1.0).x, b);
}

TEST(SpecularChainLookup, IsTheSameForWideNumbers) {
  const SpecularChain chain(test::sunny_environment({128, 64}, 100),
                            {.size = 64, .rotate_deg = 20});
  for (std::uint32_t i = 0; i < 500; ++i) {
    const Vec3<double> d = random_direction(1, i);
    const Vec3<float> one{static_cast<float>(d.x), static_cast<float>(d.y),
                          static_cast<float>(d.z)};
    const Vec3<WideFloat> wide{WideFloat(one.x), WideFloat(one.y), WideFloat(one.z)};
    const auto roughness = static_cast<float>(test::random_unit(2, i));
    EXPECT_FLOAT_EQ(chain.lookup(one, roughness).x,
                    chain.lookup(wide, WideFloat(roughness)).x.get(0));
  }
}

TEST(SpecularChainLookup, SurvivesWhatIsNoDirection) {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  const SpecularChain chain(test::sunny_environment({64, 32}, 100), {.size = 32});
  for (const Vec3<float>& d : {Vec3<float>{0, 0, 0},
                               {nan, 0, 0},
                               {nan, nan, nan},
                               {1, 1, 1},
                               {-1, -1, -1},
                               {1e30f, 1, 1}}) {
    chain.lookup(d, nan);
    chain.lookup(Vec3<WideFloat>{WideFloat(d.x), WideFloat(d.y), WideFloat(d.z)}, WideFloat(nan));
  }
}

TEST(SpecularChainLookup, TurnsWithTheEnvironment) {
  const Layers image = test::sunny_environment({128, 64}, 100);
  const SpecularChain still(image, {.size = 32}), turned(image, {.size = 32, .rotate_deg = 90});
  EXPECT_NEAR(still.lookup(Vec3<double>{0.1, 0.2, 0.97}, 0.4).x,
              turned.lookup(Vec3<double>{0.97, 0.2, -0.1}, 0.4).x, 1e-6);
}

TEST(SpecularChain, DoesNotDependOnTheThreads) {
  const Layers image = test::sunny_environment({128, 64}, 1e4);
  const auto with_threads = [&](int threads) {
    const ThreadLimit limit(threads);
    return SpecularChain(image, {.size = 32});
  };
  const SpecularChain one = with_threads(1), two = with_threads(2);
  for (int level = 0; level < one.levels(); ++level) {
    for (const CubeFace face : faces) {
      const Layers a = one.face(level, face), b = two.face(level, face);
      for (size_t c = 0; c < 3; ++c) {
        for (int y = 0; y < one.size(level); ++y) {
          for (int x = 0; x < one.size(level); ++x) {
            ASSERT_EQ(a.layers[c].plane.at(x, y), b.layers[c].plane.at(x, y));
          }
        }
      }
    }
  }
}

TEST(SpecularChain, RefusesSizesItCannotHold) {
  const Layers white = test::constant_environment({16, 8}, 1);
  EXPECT_THROW(SpecularChain(white, {.size = 0}), Error);
  EXPECT_THROW(SpecularChain(white, {.size = 5000}), Error);
  EXPECT_THROW(SpecularChain(Layers{}, {.size = 32}), Error);
}

}  // namespace
}  // namespace kiln

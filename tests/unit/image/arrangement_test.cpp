// SPDX-License-Identifier: Apache-2.0
#include "kiln/image/arrangement.h"

#include <gmock/gmock.h>

#include "kiln/core/error.h"

namespace kiln {
namespace {

using testing::HasSubstr;

ArrangementChoice chosen(Size size, Envmap envmap = Envmap::None, bool node_aligned = false) {
  return choose_arrangement(Arrangement::Auto, {size, envmap, node_aligned});
}

std::string refusal(Arrangement stated, const ImageMarks& marks) {
  try {
    choose_arrangement(stated, marks);
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::Input);
    return error.what();
  }
  ADD_FAILURE() << "nothing was refused";
  return "";
}

TEST(Arrangement, IsToldByTheRatioOfTheSides) {
  EXPECT_EQ(chosen({64, 32}).arrangement, Arrangement::LatLong);
  EXPECT_EQ(chosen({48, 8}).arrangement, Arrangement::CubeStrip);
  EXPECT_EQ(chosen({8, 48}).arrangement, Arrangement::CubeStrip);
  EXPECT_EQ(chosen({32, 24}).arrangement, Arrangement::CubeCross);
  EXPECT_EQ(chosen({24, 32}).arrangement, Arrangement::CubeCross);
  EXPECT_EQ(chosen({24, 32}).reason, "3:4");
}

TEST(Arrangement, IsWhatTheFileSaysOfItself) {
  const ArrangementChoice cube = chosen({8, 48}, Envmap::Cube, true);
  EXPECT_EQ(cube.arrangement, Arrangement::CubeStrip);
  EXPECT_THAT(cube.reason, HasSubstr("envmap"));
  EXPECT_EQ(chosen({64, 32}, Envmap::LatLong, true).arrangement, Arrangement::LatLong);
  EXPECT_EQ(chosen({65, 33}, Envmap::LatLong, true).arrangement, Arrangement::LatLong);
  EXPECT_THAT(refusal(Arrangement::Auto, {{64, 32}, Envmap::Cube}), HasSubstr("found 64 x 32"));
}

TEST(Arrangement, OfASquareHasToBeStated) {
  EXPECT_THAT(refusal(Arrangement::Auto, {{32, 32}}), HasSubstr("octahedral"));
  EXPECT_EQ(choose_arrangement(Arrangement::Octahedral, {{32, 32}}).reason, "1:1, as stated");
}

TEST(Arrangement, ThatDoesNotFitIsRefusedWithWhatWasFoundAndExpected) {
  EXPECT_THAT(refusal(Arrangement::Auto, {{65, 33}}), HasSubstr("found 65 x 33, expected 2:1"));
  EXPECT_THAT(refusal(Arrangement::LatLong, {{48, 8}}), HasSubstr("found 48 x 8, expected twice"));
  EXPECT_THAT(refusal(Arrangement::CubeStrip, {{50, 8}}), HasSubstr("6N x N or N x 6N"));
  EXPECT_THAT(refusal(Arrangement::CubeCross, {{48, 8}}), HasSubstr("4N x 3N or 3N x 4N"));
  EXPECT_THAT(refusal(Arrangement::CubeCross, {{30, 25}}), HasSubstr("found 30 x 25"));
  EXPECT_THAT(refusal(Arrangement::Octahedral, {{48, 8}}), HasSubstr("expected a square"));
  EXPECT_THAT(refusal(Arrangement::CubeFaces, {{8, 8}}), HasSubstr("<FACE>"));
}

/// A cube whose samples hold their own direction.
SphereImage direction_cube(int n, bool node_aligned = false) {
  SphereImage cube =
      cube_image(std::vector<Layers>(6, make_layers({n, n}, {"R", "G", "B"})), node_aligned);
  for (size_t f = 0; f < 6; ++f) {
    for (int y = 0; y < n; ++y) {
      for (int x = 0; x < n; ++x) {
        const Vec3<double> d = sample_direction(cube, static_cast<int>(f), x, y);
        cube.images[f].layers[0].plane.at(x, y) = static_cast<float>(d.x);
        cube.images[f].layers[1].plane.at(x, y) = static_cast<float>(d.y);
        cube.images[f].layers[2].plane.at(x, y) = static_cast<float>(d.z);
      }
    }
  }
  return cube;
}

/// One image with the faces at these places, those in `turned` by half a turn.
Layers net_of(const SphereImage& cube, Size faces, const std::vector<std::pair<int, int>>& places,
              size_t turned = 6) {
  const int n = cube.size().width;
  Layers net = make_layers({faces.width * n, faces.height * n}, {"R", "G", "B"});
  for (size_t f = 0; f < 6; ++f) {
    for (int y = 0; y < n; ++y) {
      for (int x = 0; x < n; ++x) {
        const int column = f == turned ? n - 1 - x : x, row = f == turned ? n - 1 - y : y;
        for (size_t c = 0; c < 3; ++c) {
          net.layers[c].plane.at(places[f].first * n + column, places[f].second * n + row) =
              cube.images[f].layers[c].plane.at(x, y);
        }
      }
    }
  }
  return net;
}

void expect_directions(const SphereImage& cube) {
  for (size_t f = 0; f < 6; ++f) {
    for (int y = 0; y < cube.size().height; ++y) {
      for (int x = 0; x < cube.size().width; ++x) {
        const Vec3<double> d = sample_direction(cube, static_cast<int>(f), x, y);
        ASSERT_NEAR(cube.images[f].layers[0].plane.at(x, y), d.x, 1e-6) << cube_face_names[f];
        ASSERT_NEAR(cube.images[f].layers[1].plane.at(x, y), d.y, 1e-6) << cube_face_names[f];
        ASSERT_NEAR(cube.images[f].layers[2].plane.at(x, y), d.z, 1e-6) << cube_face_names[f];
      }
    }
  }
}

TEST(Arrangement, OfStripsAndCrossesGivesTheSameCube) {
  const SphereImage cube = direction_cube(4);
  const std::vector<std::pair<int, int>> across = {{0, 0}, {1, 0}, {2, 0}, {3, 0}, {4, 0}, {5, 0}};
  const std::vector<std::pair<int, int>> down = {{0, 0}, {0, 1}, {0, 2}, {0, 3}, {0, 4}, {0, 5}};
  const std::vector<std::pair<int, int>> lying = {{2, 1}, {0, 1}, {1, 0}, {1, 2}, {1, 1}, {3, 1}};
  const std::vector<std::pair<int, int>> standing = {{2, 1}, {0, 1}, {1, 0},
                                                     {1, 2}, {1, 1}, {1, 3}};
  const auto read = [](Layers net, Arrangement arrangement) {
    const ImageMarks marks{net.size};
    return arranged(std::move(net), arrangement, marks);
  };
  expect_directions(read(net_of(cube, {6, 1}, across), Arrangement::CubeStrip));
  expect_directions(read(net_of(cube, {1, 6}, down), Arrangement::CubeStrip));
  expect_directions(read(net_of(cube, {4, 3}, lying), Arrangement::CubeCross));
  expect_directions(read(net_of(cube, {3, 4}, standing, 5), Arrangement::CubeCross));
}

// Neighbours in a net are neighbours on the cube: directions change by little from texel to texel.
TEST(Arrangement, OfCrossesIsContinuousWithinThem) {
  const SphereImage cube = direction_cube(16);
  const Layers standing = net_of(cube, {3, 4}, {{2, 1}, {0, 1}, {1, 0}, {1, 2}, {1, 1}, {1, 3}}, 5);
  for (int y = 1; y < 64; ++y) {
    for (size_t c = 0; c < 3; ++c) {
      const Plane& plane = standing.layers[c].plane;
      EXPECT_LT(std::abs(plane.at(20, y) - plane.at(20, y - 1)), 0.13) << y;
    }
  }
  const Layers lying = net_of(cube, {4, 3}, {{2, 1}, {0, 1}, {1, 0}, {1, 2}, {1, 1}, {3, 1}});
  for (int x = 1; x < 64; ++x) {
    for (size_t c = 0; c < 3; ++c) {
      const Plane& plane = lying.layers[c].plane;
      EXPECT_LT(std::abs(plane.at(x, 20) - plane.at(x - 1, 20)), 0.13) << x;
    }
  }
}

// The directions that ImfEnvmap.h draws: nodes at the borders, px (1, -t, s) and so on.
TEST(Arrangement, OfOpenExrCubesHasItsOwnOrientation) {
  constexpr int n = 5;
  Layers strip = make_layers({n, 6 * n}, {"R", "G", "B"});
  for (int f = 0; f < 6; ++f) {
    for (int y = 0; y < n; ++y) {
      for (int x = 0; x < n; ++x) {
        const double s = 2.0 * x / (n - 1) - 1, t = 2.0 * y / (n - 1) - 1;
        const std::array<Vec3<double>, 6> drawn = {
            {{1, -t, s}, {-1, -t, -s}, {s, 1, -t}, {s, -1, t}, {-s, -t, 1}, {s, -t, -1}}};
        const Vec3<double> d = normalize(drawn[static_cast<size_t>(f)]);
        strip.layers[0].plane.at(x, f * n + y) = static_cast<float>(d.x);
        strip.layers[1].plane.at(x, f * n + y) = static_cast<float>(d.y);
        strip.layers[2].plane.at(x, f * n + y) = static_cast<float>(d.z);
      }
    }
  }
  const ImageMarks marks{strip.size, Envmap::Cube, true};
  const SphereImage cube = arranged(std::move(strip), Arrangement::CubeStrip, marks);
  EXPECT_TRUE(cube.node_aligned);
  expect_directions(cube);
}

TEST(Arrangement, OfOctahedralImagesHasNoSamplesOnTheBorders) {
  const ImageMarks marks{{8, 8}, Envmap::None, true};
  EXPECT_THROW(arranged(make_layers({8, 8}, {"R", "G", "B"}), Arrangement::Octahedral, marks),
               Error);
}

}  // namespace
}  // namespace kiln

// SPDX-License-Identifier: Apache-2.0
#include "kiln/image/projection.h"

#include <gtest/gtest.h>

namespace kiln {
namespace {

void expect_direction(const Vec3<double>& d, double x, double y, double z) {
  EXPECT_NEAR(d.x, x, 1e-12);
  EXPECT_NEAR(d.y, y, 1e-12);
  EXPECT_NEAR(d.z, z, 1e-12);
}

TEST(LatLong, CentreIsPlusZLeftQuarterPlusXAndTopPlusY) {
  expect_direction(latlong_to_direction(Vec2<double>{0.5, 0.5}), 0, 0, 1);
  expect_direction(latlong_to_direction(Vec2<double>{0.25, 0.5}), 1, 0, 0);
  expect_direction(latlong_to_direction(Vec2<double>{0.75, 0.5}), -1, 0, 0);
  expect_direction(latlong_to_direction(Vec2<double>{0.3, 0.0}), 0, 1, 0);
}

TEST(LatLong, DirectionAndPointUndoEachOther) {
  for (double u = 0.01; u < 1; u += 0.07) {
    for (double v = 0.02; v < 1; v += 0.11) {
      const Vec2<double> back = direction_to_latlong(latlong_to_direction(Vec2<double>{u, v}));
      EXPECT_NEAR(back.x, u, 1e-12);
      EXPECT_NEAR(back.y, v, 1e-12);
    }
  }
}

TEST(LatLong, SolidAnglesSumToTheSphere) {
  for (const Size size : {Size{4, 2}, Size{64, 32}, Size{1000, 333}}) {
    double sum = 0;
    for (int y = 0; y < size.height; ++y) sum += latlong_texel_solid_angle(size, y) * size.width;
    EXPECT_NEAR(sum, 4 * pi, 1e-12);
  }
}

TEST(Cube, SolidAnglesSumToTheSphere) {
  for (int n : {1, 2, 7, 64}) {
    double sum = 0;
    for (int y = 0; y < n; ++y) {
      for (int x = 0; x < n; ++x) sum += 6 * cube_texel_solid_angle(n, x, y);
    }
    EXPECT_NEAR(sum, 4 * pi, 1e-11);
  }
}

TEST(Cube, FacesLookAlongTheirAxes) {
  const Vec2<double> centre{0.5, 0.5};
  expect_direction(cube_to_direction(CubeFace::px, centre), 1, 0, 0);
  expect_direction(cube_to_direction(CubeFace::ny, centre), 0, -1, 0);
  expect_direction(cube_to_direction(CubeFace::nz, centre), 0, 0, -1);
}

TEST(Cube, DirectionAndPointUndoEachOther) {
  for (int f = 0; f < 6; ++f) {
    for (double u = 0.05; u < 1; u += 0.13) {
      for (double v = 0.07; v < 1; v += 0.17) {
        const auto face = static_cast<CubeFace>(f);
        const CubePoint point = direction_to_cube(cube_to_direction(face, {u, v}));
        EXPECT_EQ(point.face, face);
        EXPECT_NEAR(point.uv.x, u, 1e-12);
        EXPECT_NEAR(point.uv.y, v, 1e-12);
      }
    }
  }
}

TEST(Cube, SolidAnglesOfNodesSumToTheSphere) {
  for (int n : {2, 3, 8, 65}) {
    double sum = 0;
    for (int y = 0; y < n; ++y) {
      for (int x = 0; x < n; ++x) sum += 6 * cube_node_solid_angle(n, x, y);
    }
    EXPECT_NEAR(sum, 4 * pi, 1e-11);
  }
}

TEST(Cube, ANodeStandsForWhatIsNearestToIt) {
  EXPECT_NEAR(cube_node_solid_angle(5, 2, 2),
              cube_rectangle_solid_angle({-0.25, -0.25}, {0.25, 0.25}), 1e-15);
  EXPECT_NEAR(cube_node_solid_angle(2, 0, 1), pi / 6, 1e-14) << "a quarter of a face";
}

TEST(Octahedral, MiddleIsUpAndCornersAreDown) {
  expect_direction(octahedral_to_direction({0.5, 0.5}), 0, 1, 0);
  expect_direction(octahedral_to_direction({1, 0.5}), 1, 0, 0);
  expect_direction(octahedral_to_direction({0.5, 1}), 0, 0, 1);
  for (const Vec2<double> corner : {Vec2<double>{0, 0}, {1, 0}, {0, 1}, {1, 1}}) {
    expect_direction(octahedral_to_direction(corner), 0, -1, 0);
  }
}

TEST(Octahedral, DirectionAndPointUndoEachOther) {
  for (double u = 0.015; u < 1; u += 0.06) {
    for (double v = 0.02; v < 1; v += 0.07) {
      const Vec3<double> d = octahedral_to_direction({u, v});
      EXPECT_NEAR(length(d), 1, 1e-15);
      const Vec2<double> back = direction_to_octahedral(d);
      EXPECT_NEAR(back.x, u, 1e-12);
      EXPECT_NEAR(back.y, v, 1e-12);
    }
  }
}

TEST(Octahedral, TheHalvesOfAnEdgeAreOne) {
  for (double t = 0.05; t < 0.5; t += 0.1) {
    const Vec3<double> a = octahedral_to_direction({t, 0}), b = octahedral_to_direction({1 - t, 0});
    expect_direction(a, b.x, b.y, b.z);
  }
}

TEST(Octahedral, SolidAnglesSumToTheSphere) {
  for (int n : {1, 2, 3, 8, 31, 64, 101}) {
    double sum = 0;
    for (int y = 0; y < n; ++y) {
      for (int x = 0; x < n; ++x) sum += octahedral_texel_solid_angle(n, x, y);
    }
    EXPECT_NEAR(sum, 4 * pi, 1e-10) << n;
  }
}

// d omega = 4 du dv / |p|^3, by the midpoint rule over each texel; odd sizes have texels across the
// edges of the octahedron.
TEST(Octahedral, SolidAngleOfATexelIsTheIntegralOverIt) {
  constexpr int points = 400;
  for (int n : {4, 5}) {
    for (const auto& [x, y] : {std::pair{0, 0}, {1, 2}, {2, 2}, {3, 0}, {2, 0}, {n - 1, 2}}) {
      double sum = 0;
      for (int j = 0; j < points; ++j) {
        for (int i = 0; i < points; ++i) {
          const Vec2<double> uv{(x + (i + 0.5) / points) / n, (y + (j + 0.5) / points) / n};
          sum += 4 / std::pow(length(octahedral_point(uv)), 3) / (n * points) / (n * points);
        }
      }
      EXPECT_NEAR(octahedral_texel_solid_angle(n, x, y), sum, 1e-4 * sum) << n << " " << x << y;
    }
  }
}

}  // namespace
}  // namespace kiln

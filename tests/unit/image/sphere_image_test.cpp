// SPDX-License-Identifier: Apache-2.0
#include "kiln/image/sphere_image.h"

#include <gtest/gtest.h>

#include "kiln/core/error.h"

namespace kiln {
namespace {

using Projection = SphereImage::Projection;

/// Samples that hold their own direction, as R G B.
SphereImage directions(SphereImage sphere) {
  for (size_t i = 0; i < sphere.images.size(); ++i) {
    for (int y = 0; y < sphere.size().height; ++y) {
      for (int x = 0; x < sphere.size().width; ++x) {
        const Vec3<double> d = sample_direction(sphere, static_cast<int>(i), x, y);
        sphere.images[i].layers[0].plane.at(x, y) = static_cast<float>(d.x);
        sphere.images[i].layers[1].plane.at(x, y) = static_cast<float>(d.y);
        sphere.images[i].layers[2].plane.at(x, y) = static_cast<float>(d.z);
      }
    }
  }
  return sphere;
}

Layers blank(Size size) { return make_layers(size, {"R", "G", "B"}); }

SphereImage blank_cube(int n, bool node_aligned = false) {
  return cube_image(std::vector<Layers>(6, blank({n, n})), node_aligned);
}

std::vector<SphereImage> all_kinds() {
  return {latlong_image(blank({12, 6})), latlong_image(blank({13, 7}), true), blank_cube(5),
          blank_cube(4, true), octahedral_image(blank({7, 7}))};
}

/// Each sample must hold what belongs at its direction of the world.
void expect_everywhere(const SphereImage& sphere,
                       const std::function<Vec3<double>(const Vec3<double>&)>& expected) {
  for (size_t i = 0; i < sphere.images.size(); ++i) {
    for (int y = 0; y < sphere.size().height; ++y) {
      for (int x = 0; x < sphere.size().width; ++x) {
        const Vec3<double> value = expected(sample_direction(sphere, static_cast<int>(i), x, y));
        ASSERT_NEAR(sphere.images[i].layers[0].plane.at(x, y), value.x, 1e-6);
        ASSERT_NEAR(sphere.images[i].layers[1].plane.at(x, y), value.y, 1e-6);
        ASSERT_NEAR(sphere.images[i].layers[2].plane.at(x, y), value.z, 1e-6);
      }
    }
  }
}

TEST(SphereImage, MirroredExchangesPlusXAndMinusX) {
  for (const SphereImage& kind : all_kinds()) {
    SphereImage sphere = directions(kind);
    mirror_x(sphere);
    expect_everywhere(sphere, [](const Vec3<double>& d) { return Vec3<double>{-d.x, d.y, d.z}; });
  }
}

TEST(SphereImage, OfZUpHasItsPlusZOnTop) {
  for (const SphereImage& kind : all_kinds()) {
    SphereImage sphere = directions(kind);
    set_up(sphere, Up::Z);
    expect_everywhere(sphere, [](const Vec3<double>& d) { return Vec3<double>{d.x, -d.z, d.y}; });
  }
}

TEST(SphereImage, ThePlusZFaceOfAZUpCubeBecomesThePlusYFace) {
  SphereImage cube = blank_cube(3);
  cube.images[static_cast<size_t>(CubeFace::pz)].layers[0].plane = Plane({3, 3}, 1.0f);
  set_up(cube, Up::Z);
  for (int f = 0; f < 6; ++f) {
    const float expected = static_cast<CubeFace>(f) == CubeFace::py ? 1.0f : 0.0f;
    EXPECT_EQ(cube.images[static_cast<size_t>(f)].layers[0].plane.at(1, 1), expected) << f;
  }
}

TEST(SphereImage, SolidAnglesOfAllSamplesSumToTheSphere) {
  for (const SphereImage& sphere : all_kinds()) {
    if (sphere.projection == Projection::LatLong && sphere.node_aligned) continue;
    double sum = 0;
    for (size_t i = 0; i < sphere.images.size(); ++i) {
      for (int y = 0; y < sphere.size().height; ++y) {
        for (int x = 0; x < sphere.size().width; ++x) sum += sample_solid_angle(sphere, x, y);
      }
    }
    EXPECT_NEAR(sum, 4 * pi, 1e-11);
  }
}

TEST(SphereImage, RefusesWhatIsNoCube) {
  std::vector<Layers> faces(6, blank({4, 4}));
  EXPECT_THROW(cube_image({faces.begin(), faces.end() - 1}), Error);
  faces[2] = blank({4, 5});
  EXPECT_THROW(cube_image(faces), Error);
  faces[2] = blank({5, 5});
  EXPECT_THROW(cube_image(faces), Error);
  faces[2] = make_layers({4, 4}, {"Y"});
  EXPECT_THROW(cube_image(faces), Error);
  EXPECT_THROW(blank_cube(1, true), Error);
  EXPECT_THROW(octahedral_image(blank({4, 3})), Error);
}

}  // namespace
}  // namespace kiln

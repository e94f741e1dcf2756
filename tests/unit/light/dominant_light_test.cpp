// SPDX-License-Identifier: Apache-2.0
#include "kiln/light/dominant_light.h"

#include <gtest/gtest.h>

#include "kiln/core/error.h"
#include "kiln/light/axes.h"
#include "kiln/light/sphere_layout.h"
#include "synthetic.h"

namespace kiln {
namespace {

TEST(DominantLight, IsTheDiscThatStandsOut) {
  const Vec3<double> sun = normalize(Vec3<double>{-0.3, 0.5, -0.8});
  constexpr double radius_rad = 0.1;
  const Layers image = test::environment_of({1024, 512}, [&](const Vec3<double>& d) {
    const bool inside = dot(d, sun) > std::cos(radius_rad);
    return inside ? Vec3<double>{100, 80, 60} : Vec3<double>{0.5, 0.5, 0.6};
  });
  const auto light = dominant_light(image);
  ASSERT_TRUE(light);
  EXPECT_GT(dot(light->direction, sun), std::cos(1e-3));
  const double solid_angle = 2 * pi * (1 - std::cos(radius_rad));
  EXPECT_NEAR(light->solid_angle, solid_angle, 0.02 * solid_angle);
  EXPECT_NEAR(light->radiance.y, 80, 1e-4);
  const double facing = pi * square(std::sin(radius_rad));
  EXPECT_NEAR(light->irradiance.x, 100 * facing, 0.02 * 100 * facing);
}

TEST(DominantLight, MayLieAcrossTheSeamOfTheImage) {
  const Layers image = test::environment_of({256, 128}, [&](const Vec3<double>& d) {
    const double value = d.z < -0.99 ? 9 : 0.1;
    return Vec3<double>{value, value, value};
  });
  const auto light = dominant_light(image);
  ASSERT_TRUE(light);
  EXPECT_NEAR(light->direction.z, -1, 1e-6);
}

TEST(DominantLight, IsAbsentInTheDarkAndUnderAnEvenSky) {
  EXPECT_FALSE(dominant_light(test::constant_environment({64, 32}, 0)));
  EXPECT_FALSE(dominant_light(test::constant_environment({64, 32}, 1)));
}

TEST(Axes, TurnDirectionsThereAndBack) {
  for (const char* text : {"x,y,z", "-x,y,z", "z,-x,y", "-z,-y,x"}) {
    const Axes axes = parse_axes(text);
    const Vec3<double> d = test::random_direction(0, 3), back = axes.to_kiln(axes.to_engine(d));
    EXPECT_NEAR(length(back - d), 0, 1e-15) << text;
  }
  EXPECT_NEAR(parse_axes("z,-x,y").to_engine({1, 2, 3}).y, -1, 0);
  EXPECT_TRUE(parse_axes("-x,y,z").is_mirror());
}

TEST(Axes, RefuseWhatIsNotThreeAxesEachOnce) {
  for (const char* text : {"", "x", "x,y", "x,y,y", "x,y,w", "x y z", "x,y,z,x", "--x,y,z"}) {
    EXPECT_THROW(parse_axes(text), Error) << text;
  }
}

TEST(Axes, MoveTheTexelsOfFacesToWhereTheEngineLooksThemUp) {
  const Axes axes = parse_axes("z,-x,y");
  constexpr int size = 8;
  std::vector<Layers> faces;
  for (int face = 0; face < 6; ++face) {
    faces.push_back(make_layers({size, size}, {"R", "G", "B"}));
    for (int y = 0; y < size; ++y) {
      for (int x = 0; x < size; ++x) {
        const Vec3<double> d =
            direction_of(SphereLayout::Cube, face, {(x + 0.5) / size, (y + 0.5) / size});
        faces.back().layers[0].plane.at(x, y) = static_cast<float>(d.x);
        faces.back().layers[1].plane.at(x, y) = static_cast<float>(d.y);
        faces.back().layers[2].plane.at(x, y) = static_cast<float>(d.z);
      }
    }
  }
  const std::vector<Layers> turned = faces_in(axes, faces);
  for (int face = 0; face < 6; ++face) {
    for (int y = 0; y < size; ++y) {
      for (int x = 0; x < size; ++x) {
        const Vec3<double> engine =
            direction_of(SphereLayout::Cube, face, {(x + 0.5) / size, (y + 0.5) / size});
        const Vec3<double> d = axes.to_kiln(engine);
        const auto& layers = turned[static_cast<size_t>(face)].layers;
        EXPECT_NEAR(layers[0].plane.at(x, y), d.x, 1e-6);
        EXPECT_NEAR(layers[1].plane.at(x, y), d.y, 1e-6);
        EXPECT_NEAR(layers[2].plane.at(x, y), d.z, 1e-6);
      }
    }
  }
}

}  // namespace
}  // namespace kiln

// SPDX-License-Identifier: Apache-2.0
#include "metalness.h"

#include <gtest/gtest.h>

namespace kiln {
namespace {

using Color = Vec3<double>;

struct Split {
  Color diffuse, f0;
};

// The metal-rough workflow, forward.
Split split_of(const Color& base, double m) {
  const auto f0 = [m](double b) { return dielectric_f0 * (1 - m) + b * m; };
  return {base * (1 - m), {f0(base.x), f0(base.y), f0(base.z)}};
}

TEST(Metalness, IsFoundAgainForEveryGreyAndEveryMetalness) {
  for (double base = 0.06; base <= 1; base += 0.0471) {
    for (double m = 0; m <= 1; m += 0.05) {
      const Split split = split_of({base, base, base}, m);
      const MetalRough<double> found = exact_metalness(split.diffuse, split.f0);
      EXPECT_NEAR(found.metallic, m, 1e-9) << base;
      EXPECT_NEAR(found.base.y, base, 1e-7) << base << " " << m;
    }
  }
}

TEST(Metalness, KeepsColoursOfPureMetalsAndPureDielectrics) {
  const Color gold{1.0, 0.77, 0.34}, clay{0.6, 0.3, 0.2};
  const MetalRough<double> metal = exact_metalness<double>({0, 0, 0}, gold);
  EXPECT_NEAR(metal.metallic, 1, 1e-6);
  EXPECT_NEAR(metal.base.x, gold.x, 1e-6);
  EXPECT_NEAR(metal.base.z, gold.z, 1e-6);
  const MetalRough<double> dielectric = exact_metalness<double>(clay, {0.04, 0.04, 0.04});
  EXPECT_NEAR(dielectric.metallic, 0, 1e-9);
  EXPECT_NEAR(dielectric.base.x, clay.x, 1e-6);
}

TEST(Metalness, OfKhronosTurnsBackItsOwnSpecularGlossiness) {
  for (double base = 0.1; base <= 1; base += 0.09) {
    for (const double m : {0.0, 0.3, 1.0}) {
      const double f0 = dielectric_f0 * (1 - m) + base * m;
      const double diffuse = f0 >= 1 ? 0 : base * (1 - dielectric_f0) * (1 - m) / (1 - f0);
      const MetalRough<double> found =
          khronos_metalness<double>({diffuse, diffuse, diffuse}, {f0, f0, f0});
      EXPECT_NEAR(found.metallic, m, 1e-6) << base;
      EXPECT_NEAR(found.base.x, base, 1e-5) << base << " " << m;
    }
  }
}

}  // namespace
}  // namespace kiln

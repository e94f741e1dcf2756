// SPDX-License-Identifier: Apache-2.0
// A thousand texels, each different, against brute-force quadrature in double.
#include <gtest/gtest.h>

#include "kiln/brdf/eon.h"
#include "kiln/brdf/roughness.h"
#include "kiln/brdf/surface.h"
#include "kiln/integrate/gauss_legendre.h"
#include "kiln/math/frame.h"
#include "kiln/math/hash.h"
#include "kiln/parallel/rows.h"
#include "kiln/table/directional_albedo.h"
#include "support/directions.h"
#include "support/scenes.h"

namespace kiln {
namespace {

constexpr Size texels{40, 25};
constexpr int count = 1000;

double sky(const Vec3<double>& d) {
  return 0.2 + std::exp(3 * (0.6 * d.x + 0.64 * d.y + 0.48 * d.z - 1)) * 8 + 0.1 * d.y * d.y;
}

double random_number(int texel, int purpose) {
  const auto bits = combine_hash<std::uint32_t>(static_cast<std::uint32_t>(texel + 1),
                                                static_cast<std::uint32_t>(purpose));
  return (bits + 0.5) * 0x1p-32;
}

struct Texel {
  double diffuse, f0, roughness, occlusion;
  Vec3<double> normal;
};

// Of the values that the maps hold, in their precision.
Texel random_texel(int i) {
  const auto stored = [](double value) { return double{static_cast<float>(value)}; };
  const double tilt = 50 * pi / 180 * random_number(i, 4), turn = 2 * pi * random_number(i, 5);
  return {stored(random_number(i, 0)),
          stored(random_number(i, 1)),
          stored(0.3 + 0.7 * random_number(i, 2)),
          stored(random_number(i, 3)),
          {stored(std::sin(tilt) * std::cos(turn)), stored(std::sin(tilt) * std::sin(turn)),
           stored(std::cos(tilt))}};
}

Svbrdf random_maps() {
  Svbrdf maps = test::uniform_svbrdf({.size = texels});
  for (int i = 0; i < count; ++i) {
    const int x = i % texels.width, y = i / texels.width;
    const Texel t = random_texel(i);
    for (size_t c = 0; c < 3; ++c) {
      maps.diffuse_color[c].at(x, y) = static_cast<float>(t.diffuse);
      maps.f0[c].at(x, y) = static_cast<float>(t.f0);
    }
    maps.roughness.at(x, y) = static_cast<float>(t.roughness);
    maps.ambient_occlusion.at(x, y) = static_cast<float>(t.occlusion);
    maps.normal[0].at(x, y) = static_cast<float>(t.normal.x);
    maps.normal[1].at(x, y) = static_cast<float>(t.normal.y);
    maps.normal[2].at(x, y) = static_cast<float>(t.normal.z);
  }
  return maps;
}

double brute_force(const Texel& t, const Rule& rule) {
  const double alpha = to_alpha(t.roughness);
  const auto average = integrate_average(alpha);
  const auto surface = Surface<double, Eon<double>>::make(
      alpha, schlick_of<double>({t.f0, t.f0, t.f0}, 1.0),
      {{t.diffuse, t.diffuse, t.diffuse}, t.roughness}, average, Energy::Multiscatter);
  const Frame<double> frame = frame_around(normalize(t.normal));
  const Vec3<double> wo = frame.to_local({0, 0, 1});
  const auto terms_o = integrate_split_sum(wo.z, alpha);
  const auto azimuths = static_cast<int>(2 * rule.nodes.size());
  double sum = 0;
  for (size_t i = 0; i < rule.nodes.size(); ++i) {
    const Albedo<double> albedo{terms_o, integrate_split_sum(rule.nodes[i], alpha), average};
    for (int j = 0; j < azimuths; ++j) {
      const Vec3<double> wi = test::direction(rule.nodes[i], 2 * pi * (j + 0.5) / azimuths);
      const Vec3<double> wm = half_vector(wo, wi);
      const auto f = surface.eval(wo, wi, wm, surface.ggx.D(wm), albedo);
      sum += rule.weights[i] * (f.specular.x + f.diffuse.x * t.occlusion) *
             sky(frame.to_world(wi)) * wi.z;
    }
  }
  return sum * 2 * pi / azimuths;
}

TEST(ReferencePreview, MeetsBruteForceAtAThousandTexelsFamilyWise) {
  const Layers latlong = test::make_latlong({1024, 512}, sky);
  const Layers image = test::preview(random_maps(), latlong, {{"samples", "4096"}});
  std::vector<double> truth(count);
  const Rule rule = gauss_legendre(128);
  for_rows(count,
           [&](int i) { truth[static_cast<size_t>(i)] = brute_force(random_texel(i), rule); });
  // Student's t of 7 degrees of freedom beyond which one in 10^5 lies: one false alarm in a hundred
  // runs of a thousand texels. A thousandth of the value is what the table of albedos may err by.
  constexpr double greatest_t = 10.1;
  double squares = 0;
  for (int i = 0; i < count; ++i) {
    const int x = i % texels.width, y = i / texels.width;
    const double found = image.find("R")->at(x, y), error = image.find("stderr.R")->at(x, y);
    const double want = truth[static_cast<size_t>(i)];
    EXPECT_NEAR(found, want, greatest_t * error + 1e-3 * want) << "texel " << i;
    EXPECT_LT(error, 0.01 * want) << "texel " << i;
    squares += square((found - want) / std::hypot(error, 5e-4 * want));
  }
  // t^2 has mean 7/5 and, truncated as it is here, a standard deviation below 5.
  EXPECT_LT(squares / count, 1.4 + 4 * 5 / std::sqrt(count));
}

}  // namespace
}  // namespace kiln

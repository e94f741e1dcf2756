// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>

#include "kiln/brdf/eon.h"
#include "kiln/brdf/lambert.h"
#include "kiln/brdf/models.h"
#include "kiln/brdf/roughness.h"
#include "kiln/brdf/surface.h"
#include "kiln/core/error.h"
#include "kiln/table/directional_albedo.h"
#include "support/scenes.h"

namespace kiln {
namespace {

using test::mean;
using test::Uniform;
using test::uniform_svbrdf;

const Layers no_environment;

// All with the table of GGX: other lobes here have a single bounce, or are compared with
// themselves.
double seen(const Uniform& material, const test::Settings& settings,
            const SurfaceChoice& surface = {}) {
  static const std::shared_ptr<const AlbedoTable> table = make_albedo_table();
  const Baked baked =
      test::bake_preview(uniform_svbrdf(material), no_environment, settings, surface, table.get());
  return mean(*baked.artifacts.at(0).image.find("R"));
}

SurfaceChoice single_bounce(const char* distribution, const char* masking) {
  SurfaceChoice surface;
  surface.distribution = distribution;
  surface.masking = masking;
  surface.energy = "none";
  return surface;
}

const Vec3<double> lamp = normalize(Vec3<double>{0.5, 0.3, 1});
constexpr const char* lamp_words = "dir:0.5,0.3,1:2,2,2";
const Vec3<double> viewer{std::sin(40 * pi / 180), 0, std::cos(40 * pi / 180)};

TEST(DirectionalLight, OnGgxIsTheFormulaWrittenOut) {
  const Uniform metal{.diffuse = 0, .f0 = 0.6f, .roughness = 0.5f};
  const double f0 = metal.f0, a2 = std::pow(0.5, 4);
  const Vec3<double> h = normalize(lamp + viewer);
  const double d = a2 / (pi * square(h.z * h.z * (a2 - 1) + 1));
  const double fresnel = f0 + (1 - f0) * std::pow(1 - dot(h, lamp), 5);
  const auto stretched = [&](double mu) { return std::sqrt(a2 + (1 - a2) * mu * mu); };
  const double correlated = 0.5 / (viewer.z * stretched(lamp.z) + lamp.z * stretched(viewer.z));
  const double separable = 1 / ((viewer.z + stretched(viewer.z)) * (lamp.z + stretched(lamp.z)));
  const test::Settings settings = {{"lights", lamp_words}, {"view", "40,0"}};
  EXPECT_NEAR(seen(metal, settings, single_bounce("ggx", "smith-correlated")) /
                  (2 * lamp.z * d * fresnel * correlated),
              1, 2e-6);
  EXPECT_NEAR(seen(metal, settings, single_bounce("ggx", "smith-separable")) /
                  (2 * lamp.z * d * fresnel * separable),
              1, 2e-6);
}

TEST(DirectionalLight, OnBeckmannIsTheFormulaWrittenOut) {
  const Uniform metal{.diffuse = 0, .f0 = 0.6f, .roughness = 0.6f};
  const double f0 = metal.f0, a2 = std::pow(0.6f, 4);
  const Vec3<double> h = normalize(lamp + viewer);
  const double c2 = h.z * h.z, c = dot(h, lamp);
  const double d = std::exp(-(1 - c2) / (a2 * c2)) / (pi * a2 * c2 * c2);
  const double fresnel = f0 + (1 - f0) * std::pow(1 - c, 5);
  const double cavity = std::min({1.0, 2 * h.z * viewer.z / c, 2 * h.z * lamp.z / c});
  const test::Settings settings = {{"lights", lamp_words}, {"view", "40,0"}};
  EXPECT_NEAR(seen(metal, settings, single_bounce("beckmann", "v-cavity")) /
                  (2 * d * fresnel * cavity / (4 * viewer.z)),
              1, 2e-5);
}

// With diffuse light, multiple bounces and coupling, from exact integrals of the lobe.
template <class Diffuse>
double exact(const Uniform& u) {
  const double alpha = to_alpha(static_cast<double>(u.roughness));
  const auto average = integrate_average(alpha);
  const auto surface = Surface<double, Diffuse>::make(
      alpha, schlick_of<double>({u.f0, u.f0, u.f0}, 1.0),
      {{u.diffuse, u.diffuse, u.diffuse}, u.roughness}, average, Energy::Multiscatter);
  const Vec3<double> wm = half_vector(viewer, lamp);
  const Albedo<double> albedo{integrate_split_sum(viewer.z, alpha),
                              integrate_split_sum(lamp.z, alpha), average};
  const auto f = surface.eval(viewer, lamp, wm, surface.ggx.D(wm), albedo);
  return (f.specular.x + f.diffuse.x) * 2 * lamp.z;
}

TEST(DirectionalLight, OfASurfaceInLayersIsItsBrdfTimesIrradiance) {
  for (const float roughness : {0.2f, 0.5f, 1.0f}) {
    const Uniform coated{.diffuse = 0.7f, .f0 = 0.05f, .roughness = roughness, .occlusion = 0.3f};
    const test::Settings settings = {{"lights", lamp_words}, {"view", "40,0"}};
    SurfaceChoice surface;
    surface.diffuse = "lambert";
    EXPECT_NEAR(seen(coated, settings, surface) / exact<Lambert<double>>(coated), 1, 1e-3);
    surface.diffuse = "eon";
    EXPECT_NEAR(seen(coated, settings, surface) / exact<Eon<double>>(coated), 1, 1e-3);
  }
}

TEST(DirectionalLight, AddsUpAndScales) {
  const Uniform metal{.diffuse = 0.5f, .f0 = 0.3f, .roughness = 0.4f};
  for (const char* masking : {"smith-correlated", "v-cavity"}) {
    SurfaceChoice surface;
    surface.masking = masking;
    const double one = seen(metal, {{"lights", "dir:0,0,1:1,1,1"}}, surface);
    const double other = seen(metal, {{"lights", "dir:1,0,1:0.5,1,1"}}, surface);
    EXPECT_DOUBLE_EQ(seen(metal, {{"lights", "dir:0,0,3:4,4,4"}}, surface), 4 * one);
    EXPECT_NEAR(seen(metal, {{"lights", "dir:0,0,1:1,1,1; dir:1,0,1:0.5,1,1"}}, surface),
                one + other, 1e-6 * one);
  }
}

TEST(DirectionalLight, ComesFromAboveTheShadingNormalOnly) {
  Uniform flat{.diffuse = 0.8f}, leaning{.diffuse = 0.8f};
  leaning.normal = {-0.6f, 0, 0.8f};
  EXPECT_EQ(seen(flat, {{"lights", "dir:0,0.3,-1:9,9,9"}}), 0);
  EXPECT_EQ(seen(leaning, {{"lights", "dir:0.9,0,0.5:9,9,9"}}), 0);
  EXPECT_EQ(seen(flat, {{"lights", "dir:-1,0,-0.1:9,9,9"}}), 0);
  EXPECT_GT(seen(leaning, {{"lights", "dir:-1,0,-0.1:9,9,9"}}), 0.5);
}

TEST(DirectionalLight, IsTheSameInEveryMode) {
  const Uniform material{.diffuse = 0.5f, .f0 = 0.3f, .roughness = 0.4f};
  const std::string light = "dir:0.5,0.5,1:3,2,1";
  EXPECT_EQ(seen(material, {{"lights", light}}),
            seen(material, {{"lights", light}, {"mode", "split-sum"}}));
  EXPECT_EQ(seen(material, {{"lights", light}, {"mode", "difference"}}), 0);
  const Layers room = test::constant_latlong(1);
  const Svbrdf maps = uniform_svbrdf(material);
  for (const char* mode : {"reference", "split-sum"}) {
    const double dark = seen(material, {{"lights", light}});
    const double lit = mean(*test::preview(maps, room, {{"mode", mode}}).find("R"));
    const Layers both = test::preview(maps, room, {{"mode", mode}, {"lights", light}});
    EXPECT_NEAR(mean(*both.find("R")), lit + dark, 1e-5) << mode;
  }
}

TEST(DirectionalLight, StaysWhereItIsWhenTheEnvironmentTurns) {
  const Uniform material{.diffuse = 0.5f, .roughness = 0.4f};
  EXPECT_NEAR(seen(material, {{"lights", "dir:1,0,1:1,1,1"}, {"rotate", "90"}}),
              seen(material, {{"lights", "dir:1,0,1:1,1,1"}}), 1e-6);
}

// The texels of a lat-long that a disc of 1.4 degrees covers, so bright that irradiance is 3 on a
// plane that faces it.
Layers sun_toward(const Vec3<double>& toward) {
  constexpr Size size{2048, 1024};
  const double cap = std::cos(0.7 * pi / 180), reach = 1.5 * pi / 180;
  const double colatitude = std::acos(toward.y);
  Layers sun = make_layers(size, {"R", "G", "B"});
  std::vector<std::pair<int, int>> covered;
  double solid_angle = 0;
  for (int y = 0; y < size.height; ++y) {
    if (std::abs(pi * (y + 0.5) / size.height - colatitude) > reach) continue;
    for (int x = 0; x < size.width; ++x) {
      const Vec2<double> uv{(x + 0.5) / size.width, (y + 0.5) / size.height};
      if (dot(latlong_to_direction<double>(uv), toward) < cap) continue;
      solid_angle += latlong_texel_solid_angle(size, y);
      covered.emplace_back(x, y);
    }
  }
  for (const auto& [x, y] : covered) {
    for (Layer& layer : sun.layers) layer.plane.at(x, y) = static_cast<float>(3 / solid_angle);
  }
  return sun;
}

// One picture of two materials side by side: the sun is made ready once.
TEST(DirectionalLight, IsWhatASmallSunComesTo) {
  const std::array<float, 2> roughness{0.5f, 0.9f};
  const auto material = [&](size_t half) {
    return Uniform{.diffuse = 0.6f, .f0 = 0.1f, .roughness = roughness[half]};
  };
  Svbrdf halves = uniform_svbrdf(material(0));
  for (int y = 0; y < 16; ++y) {
    for (int x = 8; x < 16; ++x) halves.roughness.at(x, y) = roughness[1];
  }
  const Layers lit =
      test::preview(halves, sun_toward(normalize(Vec3<double>{0.4, 0.3, 1})), {{"samples", "512"}});
  const auto mean_of_half = [&](const char* layer, size_t half) {
    double sum = 0;
    for (int y = 0; y < 16; ++y) {
      for (int x = 0; x < 8; ++x) sum += lit.find(layer)->at(x + 8 * static_cast<int>(half), y);
    }
    return sum / 128;
  };
  for (const size_t half : {0u, 1u}) {
    const double error = mean_of_half("stderr.R", half) / std::sqrt(128);
    const double point = seen(material(half), {{"lights", "dir:0.4,0.3,1:3,3,3"}});
    // The sun is 1.4 degrees wide, blurred by half a texel: less than one in a thousand.
    EXPECT_NEAR(mean_of_half("R", half), point, 4 * error + 1e-3 * point);
    EXPECT_LT(error, 2e-3 * point);
  }
}

TEST(DirectionalLight, IsRefusedWhereItMeansNothing) {
  for (const char* words : {"dir:0,0,0:1,1,1", "dir:0,0,1", "sun:0,0,1:1,1,1", "dir:0,0:1,1,1",
                            "dir:0,0,1:1,1,-1", "dir:0,0,nan:1,1,1", "dir:0,0,1:1,1,1;"}) {
    EXPECT_THROW(make_recipe("preview")->set("lights", words); seen({}, {{"lights", words}}), Error)
        << words;
  }
  SurfaceChoice glass;
  glass.bsdf = "glass";
  EXPECT_THROW(seen({}, {{"lights", "dir:0,0,1:1,1,1"}}, glass), Error);
  EXPECT_THROW(seen({}, {}), Error);
}

}  // namespace
}  // namespace kiln

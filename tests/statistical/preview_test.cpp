// SPDX-License-Identifier: Apache-2.0
// Reference previews against deterministic truth, judged by the standard errors they state.
#include <gtest/gtest.h>

#include "kiln/brdf/eon.h"
#include "kiln/brdf/lambert.h"
#include "kiln/brdf/roughness.h"
#include "kiln/brdf/surface.h"
#include "kiln/integrate/gauss_legendre.h"
#include "kiln/table/directional_albedo.h"
#include "support/directions.h"
#include "support/scenes.h"

namespace kiln {
namespace {

// A smooth sky, brighter toward one side: radiance the estimator has to integrate.
double sky(const Vec3<double>& d) { return std::exp(2 * (0.6 * d.x + 0.8 * d.z)); }

// INT f L cos over the hemisphere by quadrature in double, with exact split-sum terms.
template <class Diffuse>
double integrate_radiance(const test::Uniform& u, const Vec3<double>& wo) {
  const double alpha = to_alpha(static_cast<double>(u.roughness));
  const auto fresnel = schlick_of<double>({u.f0, u.f0, u.f0}, 1.0);
  const auto average = integrate_average(alpha);
  const auto surface = Surface<double, Diffuse>::make(
      alpha, fresnel, {{u.diffuse, u.diffuse, u.diffuse}, u.roughness}, average,
      Energy::Multiscatter);
  const auto terms_o = integrate_split_sum(wo.z, alpha);
  const Rule rule = gauss_legendre(96);
  constexpr int azimuths = 384;
  double sum = 0;
  for (size_t i = 0; i < rule.nodes.size(); ++i) {
    const auto terms_i = integrate_split_sum(rule.nodes[i], alpha);
    for (int j = 0; j < azimuths; ++j) {
      const Vec3<double> wi = test::direction(rule.nodes[i], 2 * pi * (j + 0.5) / azimuths);
      const Vec3<double> wm = half_vector(wo, wi);
      const auto f = surface.eval(wo, wi, wm, surface.ggx.D(wm), {terms_o, terms_i, average});
      sum += rule.weights[i] * (f.specular.x + f.diffuse.x * u.occlusion) * sky(wi) * wi.z;
    }
  }
  return sum * 2 * pi / azimuths;
}

struct Scene {
  test::Uniform material;
  const char* diffuse;
  double theta_deg;
};

TEST(ReferencePreview, MeetsTheIntegralWithinItsStatedError) {
  const std::vector<Scene> scenes = {
      {{.diffuse = 0.8f, .f0 = 0.04f, .roughness = 0.5f}, "lambert", 0},
      {{.diffuse = 0.8f, .f0 = 0.04f, .roughness = 0.5f, .occlusion = 0.5f}, "eon", 30},
      {{.diffuse = 0.0f, .f0 = 0.9f, .roughness = 0.4f}, "eon", 60},
      {{.diffuse = 0.5f, .f0 = 0.3f, .roughness = 1.0f}, "lambert", 75},
      {{.diffuse = 0.5f, .f0 = 0.5f, .roughness = 0.35f}, "eon", 45}};
  const Layers latlong = test::make_latlong({1024, 512}, sky);
  for (const Scene& scene : scenes) {
    const std::string view = std::to_string(scene.theta_deg) + ",0";
    const Layers image = test::preview(test::uniform_svbrdf(scene.material), latlong,
                                       {{"samples", "1024"}, {"view", view}}, scene.diffuse);
    const Vec3<double> wo = test::direction(std::cos(scene.theta_deg * pi / 180), 0);
    const double truth = std::string(scene.diffuse) == "eon"
                             ? integrate_radiance<Eon<double>>(scene.material, wo)
                             : integrate_radiance<Lambert<double>>(scene.material, wo);
    // 256 independent texels: their mean has a sixteenth of one texel's error. 6e-4 more is what
    // the albedo table may err by, and 4 standard errors is 0.03 % family-wise.
    const double error = test::mean(*image.find("stderr.R")) / 16;
    EXPECT_NEAR(test::mean(*image.find("R")), truth, 4 * error + 1e-3 * truth)
        << scene.diffuse << " at " << scene.theta_deg;
    EXPECT_LT(error, 1e-3 * truth);
  }
}

TEST(ReferencePreview, StatesTheErrorItHas) {
  // The spread of independent texels around their mean is the standard error each states.
  const Layers latlong = test::make_latlong({256, 128}, sky);
  test::Uniform material;
  material.size = {64, 64};
  const Layers image = test::preview(test::uniform_svbrdf(material), latlong, {{"samples", "64"}});
  const Plane &value = *image.find("R"), &stated = *image.find("stderr.R");
  const double mean = test::mean(value);
  double spread = 0, errors = 0;
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      spread += square(value.at(x, y) - mean);
      errors += square(stated.at(x, y));
    }
  }
  EXPECT_NEAR(std::sqrt(errors / spread), 1, 0.08);
}

}  // namespace
}  // namespace kiln

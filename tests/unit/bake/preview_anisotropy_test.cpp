// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "kiln/brdf/ggx.h"
#include "kiln/brdf/smith.h"
#include "kiln/brdf/surface.h"
#include "kiln/integrate/gauss_legendre.h"
#include "support/directions.h"
#include "support/scenes.h"

namespace kiln {
namespace {

using test::mean;

// Brushed metal whose lobe is wider along the angle.
struct Brushed {
  double alpha_x = 0.5, alpha_y = 0.2;
  double angle_deg = 0;
  Size size{16, 16};
  float f0 = 1;
};

Svbrdf brushed(const Brushed& b) {
  const double mean_alpha = std::sqrt(b.alpha_x * b.alpha_y);
  Svbrdf s = test::uniform_svbrdf({.size = b.size,
                                   .diffuse = 0,
                                   .f0 = b.f0,
                                   .roughness = static_cast<float>(std::sqrt(mean_alpha))});
  s.anisotropy = Plane(b.size, static_cast<float>((1 - b.alpha_y / b.alpha_x) / 0.9));
  s.anisotropy_angle = Plane(b.size, static_cast<float>(b.angle_deg * pi / 180));
  return s;
}

SurfaceChoice lobe_alone(const char* masking) {
  SurfaceChoice surface;
  surface.masking = masking;
  surface.energy = "none";
  return surface;
}

Layers seen(const Svbrdf& maps, const Layers& latlong, const test::Settings& settings,
            const char* masking = "smith-correlated") {
  return test::bake_preview(maps, latlong, settings, lobe_alone(masking)).artifacts.at(0).image;
}

double brightness(const Svbrdf& maps, const test::Settings& settings,
                  const char* masking = "smith-correlated") {
  return mean(*seen(maps, Layers{}, settings, masking).find("R"));
}

Vec3<double> turned(const Vec3<double>& w, double angle) {
  return {w.x * std::cos(angle) - w.y * std::sin(angle),
          w.x * std::sin(angle) + w.y * std::cos(angle), w.z};
}

TEST(AnisotropicPreview, UnderALightIsTheFormulaWrittenOut) {
  const Vec3<double> wi = normalize(Vec3<double>{0.4, -0.3, 1});
  const Vec3<double> wo{std::sin(40 * pi / 180), 0, std::cos(40 * pi / 180)};
  for (const double angle : {0.0, 30.0, 100.0, -70.0}) {
    // In the frame of the wider axis.
    const Vec3<double> i = turned(wi, -angle * pi / 180), o = turned(wo, -angle * pi / 180);
    const Vec3<double> h = normalize(i + o);
    const double ax = 0.5, ay = 0.2;
    const double d = 1 / (pi * ax * ay * square(square(h.x / ax) + square(h.y / ay) + square(h.z)));
    const auto stretched = [&](const Vec3<double>& w) {
      return std::hypot(ax * w.x, ay * w.y, w.z);
    };
    const double correlated = 0.5 / (o.z * stretched(i) + i.z * stretched(o));
    const double separable = 1 / ((o.z + stretched(o)) * (i.z + stretched(i)));
    const test::Settings settings = {{"lights", "dir:0.4,-0.3,1:1,1,1"}, {"view", "40,0"}};
    const Svbrdf maps = brushed({.angle_deg = angle});
    EXPECT_NEAR(brightness(maps, settings) / (i.z * d * correlated), 1, 1e-5) << angle;
    EXPECT_NEAR(brightness(maps, settings, "smith-separable") / (i.z * d * separable), 1, 1e-5)
        << angle;
  }
}

TEST(AnisotropicPreview, InAWhiteRoomReflectsTheAlbedoOfItsLobe) {
  // Directional albedos at n.v = 0.4 for widths 0.1 and 0.6, by quadrature.
  const struct {
    double azimuth, albedo;
  } known[] = {{0.8, 0.77229906700918}, {0, 0.73627123725}, {pi / 2, 0.79441271444}};
  const double theta = std::acos(0.4) * 180 / pi;
  for (const auto& [azimuth, albedo] : known) {
    // The axes of those: 0.1 along +x, 0.6 along +y.
    const Svbrdf maps = brushed({.alpha_x = 0.6, .alpha_y = 0.1, .angle_deg = 90});
    const std::string view = std::to_string(theta) + "," + std::to_string(azimuth * 180 / pi);
    const Layers image =
        seen(maps, test::constant_latlong(1), {{"view", view}, {"samples", "1024"}});
    const double error = mean(*image.find("stderr.R")) / 16;
    EXPECT_NEAR(mean(*image.find("R")), albedo, 4 * error + 2e-4) << azimuth;
    EXPECT_LT(error, 1e-3);
  }
}

double sky(const Vec3<double>& d) { return std::exp(2 * (0.6 * d.x - 0.5 * d.y + 0.6 * d.z)); }

TEST(AnisotropicPreview, MeetsTheIntegralUnderASky) {
  const Layers latlong = test::make_latlong({1024, 512}, sky);
  const Vec3<double> wo = test::direction(std::cos(50 * pi / 180), 0);
  const double angle = 35 * pi / 180;
  const Ggx<double> ggx{0.5, 0.2};
  const Rule rule = gauss_legendre(160);
  constexpr int azimuths = 640;
  double truth = 0;
  for (size_t k = 0; k < rule.nodes.size(); ++k) {
    for (int j = 0; j < azimuths; ++j) {
      const Vec3<double> wi = test::direction(rule.nodes[k], 2 * pi * (j + 0.5) / azimuths);
      const Vec3<double> i = turned(wi, -angle), o = turned(wo, -angle);
      const Vec3<double> wm = half_vector(o, i);
      truth += rule.weights[k] * sky(wi) * wi.z * ggx.D(wm) *
               SmithCorrelated<double>::visibility(ggx, o, i, wm) * 2 * pi / azimuths;
    }
  }
  const Layers image =
      seen(brushed({.angle_deg = 35}), latlong, {{"view", "50,0"}, {"samples", "1024"}});
  const double error = mean(*image.find("stderr.R")) / 16;
  EXPECT_NEAR(mean(*image.find("R")), truth, 4 * error + 3e-4 * truth);
}

TEST(AnisotropicPreview, OfAWhiteMetalInAWhiteRoomIsWhiteOnTheMeanOverAzimuths) {
  for (const double alpha_y : {0.35, 0.2}) {
    const Svbrdf maps = brushed({.alpha_x = 0.5, .alpha_y = alpha_y});
    double sum = 0;
    for (const char* view : {"50,0", "50,45", "50,90", "50,135"}) {
      sum +=
          mean(*test::preview(maps, test::constant_latlong(1), {{"view", view}, {"samples", "512"}})
                    .find("R"));
    }
    EXPECT_NEAR(sum / 4, 1, 0.01) << alpha_y;
  }
}

TEST(AnisotropicPreview, IsTheSameAtOppositeAngles) {
  const test::Settings settings = {{"lights", "dir:0.4,-0.3,1:1,1,1"}, {"view", "40,0"}};
  EXPECT_NEAR(brightness(brushed({.angle_deg = 20}), settings),
              brightness(brushed({.angle_deg = 200}), settings), 1e-5);
}

TEST(AnisotropicPreview, WithoutStrengthIsTheIsotropicOneToTheBit) {
  const Svbrdf isotropic = test::uniform_svbrdf({});
  Svbrdf none = isotropic;
  none.anisotropy = Plane(none.size, 0.0f);
  none.anisotropy_angle = Plane(none.size, 1.0f);
  for (const char* mode : {"reference", "split-sum"}) {
    const Layers a = test::preview(isotropic, test::constant_latlong(1), {{"mode", mode}});
    const Layers b = test::preview(none, test::constant_latlong(1), {{"mode", mode}});
    EXPECT_EQ(mean(*a.find("R")), mean(*b.find("R"))) << mode;
  }
}

TEST(AnisotropicPreview, AveragesAnglesAsAxesWherePixelsLieBetweenTexels) {
  Svbrdf striped = brushed({});
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 16; ++x) {
      striped.anisotropy_angle.at(x, y) = static_cast<float>((x % 2 ? 178 : 2) * pi / 180);
    }
  }
  const test::Settings settings = {
      {"lights", "dir:0.5,0,1:1,1,1"}, {"view", "40,90"}, {"size", "160"}};
  const double even = brightness(brushed({}), settings);
  EXPECT_NEAR(brightness(striped, settings), even, 0.02 * even);
}

TEST(AnisotropicPreview, StretchesHighlightsAcrossTheGroovesInSplitSumToo) {
  const Layers lamp = test::make_latlong({256, 128}, [](const Vec3<double>& d) {
    return dot(d, {0, 0, 1}) > 0.99 ? 100.0 : 0.0;
  });
  // The lobe is wide along the meridians of the ball: the highlight is tall.
  const Svbrdf maps = brushed({.alpha_x = 0.6, .alpha_y = 0.1, .angle_deg = 90, .f0 = 0.9f});
  for (const char* mode : {"reference", "split-sum"}) {
    const Layers ball = seen(maps, lamp, {{"shape", "sphere"}, {"size", "64"}, {"mode", mode}});
    const Plane& red = *ball.find("R");
    EXPECT_GT(red.at(32, 20) + red.at(32, 44), 1.3 * (red.at(20, 32) + red.at(44, 32))) << mode;
  }
}

TEST(AnisotropicPreview, TellsWhereItIsNotRead) {
  SurfaceChoice surface;
  surface.distribution = "gtr";
  const Baked baked =
      test::bake_preview(brushed({}), test::constant_latlong(1), {{"samples", "16"}}, surface);
  ASSERT_FALSE(baked.notes.empty());
  EXPECT_EQ(baked.notes[0], "anisotropy is not read: gtr has one width");
}

}  // namespace
}  // namespace kiln

// SPDX-License-Identifier: Apache-2.0
// Previews of any listed models: energy, agreement with the fused loop, and glass.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "kiln/brdf/models.h"
#include "kiln/brdf/roughness.h"
#include "kiln/parallel/threads.h"
#include "kiln/table/lobe.h"
#include "support/faults.h"
#include "support/scenes.h"

namespace kiln {
namespace {

using test::bake_preview;
using test::mean;
using test::Uniform;
using test::uniform_svbrdf;
using testing::Contains;
using testing::HasSubstr;

const Layers& picture_of(const Baked& baked) { return baked.artifacts.at(0).image; }

double furnace(const Uniform& texel, const SurfaceChoice& surface, const char* view = "40,0") {
  const Baked baked = bake_preview(uniform_svbrdf(texel), test::constant_latlong(1),
                                   {{"samples", "256"}, {"view", view}}, surface);
  return mean(*picture_of(baked).find("R"));
}

double figure(const Baked& baked, const std::string& name) {
  for (const auto& [known, value] : baked.figures) {
    if (known == name) return value;
  }
  return std::nan("");
}

Svbrdf varied_svbrdf() {
  Svbrdf s = uniform_svbrdf({.size = {32, 16}});
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 32; ++x) {
      s.roughness.at(x, y) = 0.05f + 0.03f * static_cast<float>(x);
      s.f0[0].at(x, y) = 0.06f * static_cast<float>(y);
      s.normal[0].at(x, y) = 0.4f * std::sin(static_cast<float>(x + y));
      s.normal[2].at(x, y) = std::sqrt(1 - square(s.normal[0].at(x, y)));
    }
  }
  return s;
}

Layers lamp() {
  const Vec3<double> toward = normalize(Vec3<double>{0.6, 0.2, 0.8});
  return test::make_latlong({64, 32}, [=](const Vec3<double>& d) {
    return dot(d, toward) > 0.9 ? 9.0 : 0.1 + d.y * d.y;
  });
}

// Models that differ from the common ones by less than a float holds, so that they run in stages.
SurfaceChoice common_models_in_stages() {
  SurfaceChoice surface;
  surface.f90 = 1 - 1e-9;
  return surface;
}

TEST(StagedPreview, AgreesWithTheFusedLoopToRounding) {
  for (const char* mode : {"reference", "split-sum"}) {
    for (const char* diffuse : {"lambert", "eon", "burley"}) {
      for (const char* energy : {"kulla-conty", "none"}) {
        SurfaceChoice fused, staged = common_models_in_stages();
        fused.diffuse = staged.diffuse = diffuse;
        fused.energy = staged.energy = energy;
        const test::Settings settings = {{"mode", mode}, {"view", "30,20"}};
        const Baked a = bake_preview(varied_svbrdf(), lamp(), settings, fused);
        const Baked b = bake_preview(varied_svbrdf(), lamp(), settings, staged);
        for (int y = 0; y < 16; ++y) {
          for (int x = 0; x < 32; ++x) {
            const float one = picture_of(a).find("R")->at(x, y);
            EXPECT_NEAR(picture_of(b).find("R")->at(x, y), one, 2e-5f * one)
                << mode << " " << diffuse << " " << energy << " at " << x << "," << y;
          }
        }
      }
    }
  }
}

TEST(StagedPreview, OfAWhiteMetalIsWhiteWithEveryEnergyModel) {
  const std::pair<const char*, const char*> lobes[] = {{"ggx", "smith-separable"},
                                                       {"beckmann", "smith-correlated"},
                                                       {"phong", "smith-correlated"},
                                                       {"gtr", "implicit"}};
  for (const auto& [distribution, masking] : lobes) {
    for (const char* energy : {"kulla-conty", "turquin", "fdez-aguera"}) {
      SurfaceChoice surface;
      surface.distribution = distribution;
      surface.masking = masking;
      surface.energy = energy;
      for (const float roughness : {0.3f, 0.9f}) {
        const Uniform metal{.size = {32, 32}, .diffuse = 0, .f0 = 1, .roughness = roughness};
        EXPECT_NEAR(furnace(metal, surface), 1, 3e-3)
            << distribution << " " << masking << " " << energy << " " << roughness;
      }
    }
  }
}

TEST(StagedPreview, OfAWhiteLambertSurfaceIsWhiteWhereTheoryHasIt) {
  const Uniform white{.size = {32, 32}, .diffuse = 1, .f0 = 0.04f, .roughness = 0.6f};
  for (const char* distribution : {"ggx", "beckmann", "phong"}) {
    for (const char* energy : {"kulla-conty", "turquin", "fdez-aguera", "none"}) {
      SurfaceChoice surface;
      surface.distribution = distribution;
      surface.diffuse = "lambert";
      surface.energy = energy;
      surface.coupling = "albedo-scaling";
      EXPECT_NEAR(furnace(white, surface), 1, 3e-3) << distribution << " " << energy;
    }
    for (const char* energy : {"kulla-conty", "none"}) {
      SurfaceChoice surface;
      surface.distribution = distribution;
      surface.diffuse = "lambert";
      surface.energy = energy;
      EXPECT_NEAR(furnace(white, surface), 1, 3e-3) << distribution << " " << energy;
    }
  }
}

// Coupling takes the reflectance of an exact Fresnel at an effective cosine.
TEST(StagedPreview, OfAWhiteSurfaceUnderAnyFresnelIsWhiteToItsStatedError) {
  const Uniform white{.size = {32, 32}, .diffuse = 1, .f0 = 0.04f, .roughness = 0.5f};
  for (const std::string& fresnel : model_names("fresnel")) {
    SurfaceChoice surface;
    surface.fresnel = fresnel;
    surface.diffuse = "lambert";
    surface.coupling = "albedo-scaling";
    if (fresnel == "hoffman-f82") surface.f82 = 0.4;
    for (const char* view : {"0,0", "60,0", "80,0"}) {
      EXPECT_NEAR(furnace(white, surface, view), 1, 1.5e-2) << fresnel << " " << view;
    }
  }
}

TEST(StagedPreview, SaysByHowMuchALobeGains) {
  SurfaceChoice cloth;
  cloth.distribution = "charlie";
  cloth.masking = "neubelt";
  const Baked baked =
      bake_preview(uniform_svbrdf({}), test::constant_latlong(1), {{"samples", "16"}}, cloth);
  EXPECT_THAT(baked.notes, Contains(HasSubstr("times what it receives")));
}

TEST(StagedPreview, RefusesModelsThatDoNotFit) {
  SurfaceChoice surface;
  surface.distribution = "charlie";
  EXPECT_THROW(check_surface(surface), Error);
  EXPECT_THROW(assign(surface_params(), surface, "distribution", "gxx"), Error);
  assign(surface_params(), surface, "energy", "multiscatter");
  EXPECT_EQ(surface.energy, "kulla-conty");
  assign(surface_params(), surface, "energy", "single");
  EXPECT_EQ(surface.energy, "none");
}

TEST(StagedPreview, OfEveryListedModelIsFiniteAndNotNegative) {
  const auto shared = make_albedo_table();
  const auto expect_sound = [&](const SurfaceChoice& surface, const std::string& which,
                                const std::vector<const char*>& modes) {
    for (const char* mode : modes) {
      const Baked baked = bake_preview(varied_svbrdf(), lamp(),
                                       {{"samples", "16"}, {"mode", mode}, {"view", "60,0"}},
                                       surface, shared.get());
      const Oddities odd = count_oddities(picture_of(baked));
      EXPECT_EQ(odd.nan + odd.inf + odd.negative, 0) << which << " " << mode;
    }
  };
  for_each_lobe([&]<template <class> class Distribution, template <class> class Masking>() {
    SurfaceChoice surface;
    surface.distribution = Distribution<double>::name;
    surface.masking = Masking<double>::name;
    surface.fresnel = "dielectric";
    expect_sound(surface, surface.distribution + " " + surface.masking, {"reference"});
  });
  for (const std::string& fresnel : model_names("fresnel")) {
    SurfaceChoice surface;
    surface.fresnel = fresnel;
    surface.energy = "turquin";
    expect_sound(surface, fresnel, {"reference", "split-sum"});
  }
  for (const std::string& diffuse : model_names("diffuse")) {
    SurfaceChoice surface;
    surface.diffuse = diffuse;
    surface.coupling = "albedo-scaling";
    expect_sound(surface, diffuse, {"reference", "split-sum"});
  }
}

SurfaceChoice glass() {
  SurfaceChoice surface;
  surface.bsdf = "glass";
  return surface;
}

// Mean over the pixels that show the body, of columns from one to before another.
double mean_shown(const Layers& image, int from = 0, int to = -1) {
  double shown = 0, pixels = 0;
  for (int y = 0; y < image.size.height; ++y) {
    for (int x = from; x < (to < 0 ? image.size.width : to); ++x) {
      shown += image.find("R")->at(x, y);
      pixels += image.find("A")->at(x, y) > 0;
    }
  }
  return shown / pixels;
}

struct Bent {
  float roughness, lean;
};
constexpr std::array<Bent, 6> bent_glasses{
    {{0.05f, 0}, {0.05f, 0.3f}, {0.3f, 0}, {0.3f, 0.3f}, {0.8f, 0}, {0.8f, 0.3f}}};

Uniform texel_of(const Bent& bent, Size size) {
  Uniform texel{.size = size, .roughness = bent.roughness};
  texel.normal = {bent.lean, 0, std::sqrt(1 - bent.lean * bent.lean)};
  return texel;
}

// Side by side on one plane, for every picture of glass integrates its albedos first.
TEST(GlassPreview, OfAPlaneInAWhiteRoomIsWhiteHoweverRoughAndBent) {
  constexpr int wide = 32, margin = 4;
  const Size size{wide * static_cast<int>(bent_glasses.size()), 24};
  Svbrdf strips = uniform_svbrdf({.size = size});
  for (int x = 0; x < size.width; ++x) {
    const Svbrdf one =
        uniform_svbrdf(texel_of(bent_glasses[static_cast<size_t>(x / wide)], {1, 1}));
    for (int y = 0; y < size.height; ++y) {
      strips.roughness.at(x, y) = one.roughness.at(0, 0);
      for (size_t c = 0; c < 3; ++c) strips.normal[c].at(x, y) = one.normal[c].at(0, 0);
    }
  }
  const Baked baked = bake_preview(strips, test::constant_latlong(1),
                                   {{"view", "40,0"}, {"samples", "128"}}, glass());
  for (size_t i = 0; i < bent_glasses.size(); ++i) {
    const int from = wide * static_cast<int>(i);
    EXPECT_NEAR(mean_shown(picture_of(baked), from + margin, from + wide - margin), 1, 1e-2)
        << bent_glasses[i].roughness << " " << bent_glasses[i].lean;
  }
  EXPECT_NEAR(figure(baked, "energy lost"), 1 - mean_shown(picture_of(baked)), 1e-4);
}

TEST(GlassPreview, OfABallInAWhiteRoomIsWhiteHoweverRoughAndBent) {
  for (const Bent& bent : bent_glasses) {
    const Baked baked =
        bake_preview(uniform_svbrdf(texel_of(bent, {16, 16})), test::constant_latlong(1),
                     {{"shape", "sphere"}, {"size", "24"}, {"samples", "128"}}, glass());
    EXPECT_NEAR(mean_shown(picture_of(baked)), 1, 1e-2) << bent.roughness << " " << bent.lean;
    EXPECT_NEAR(figure(baked, "energy lost"), 1 - mean_shown(picture_of(baked)), 1e-4);
  }
}

TEST(GlassPreview, OfASingleBounceLosesInAWhiteRoomExactlyWhatItSays) {
  SurfaceChoice single = glass();
  single.energy = "none";
  const Baked baked = bake_preview(uniform_svbrdf({.roughness = 0.8f}), test::constant_latlong(1),
                                   {{"shape", "sphere"}, {"size", "32"}}, single);
  const double lost = figure(baked, "energy lost");
  EXPECT_GT(lost, 0.1);
  EXPECT_NEAR(mean_shown(picture_of(baked)), 1 - lost, 1e-4);
}

TEST(GlassPreview, OfABallTurnsWhatIsBehindItUpsideDown) {
  const Layers sky = test::make_latlong({64, 32}, [](const Vec3<double>& d) { return d.y > 0; });
  const Baked baked = bake_preview(uniform_svbrdf({.roughness = 0.02f}), sky,
                                   {{"shape", "sphere"}, {"size", "32"}}, glass());
  const Plane& image = *picture_of(baked).find("R");
  EXPECT_LT(image.at(16, 10), 0.2);
  EXPECT_GT(image.at(16, 22), 0.8);
}

TEST(GlassPreview, OfIndexOneIsNotThere) {
  SurfaceChoice air = glass();
  air.ior = 1;
  const Layers sky =
      test::make_latlong({64, 32}, [](const Vec3<double>& d) { return 1.5 + d.x * d.y; });
  const Baked baked = bake_preview(uniform_svbrdf({.roughness = 0.1f}), sky,
                                   {{"shape", "sphere"}, {"size", "32"}}, air);
  EXPECT_NEAR(figure(baked, "energy lost"), 0, 1e-3);
  EXPECT_NEAR(picture_of(baked).find("R")->at(16, 16), 1.5, 1e-2);
}

TEST(GlassPreview, IsOfTheReferenceModeOnly) {
  for (const char* mode : {"split-sum", "difference"}) {
    const std::string text = test::fault_text(Fault::Usage, [&] {
      bake_preview(uniform_svbrdf({}), test::constant_latlong(1), {{"mode", mode}}, glass());
    });
    EXPECT_THAT(text, HasSubstr("mode reference only"));
  }
}

TEST(ModelsInPreviews, GiveTheSameBytesForAnyNumberOfThreads) {
  SurfaceChoice phong;
  phong.distribution = "phong";
  phong.fresnel = "conductor";
  for (const SurfaceChoice& surface : {phong, glass()}) {
    const auto run = [&](int threads) {
      const ThreadLimit limit(threads);
      return picture_of(bake_preview(varied_svbrdf(), lamp(),
                                     {{"shape", "sphere"}, {"size", "24"}, {"samples", "16"}},
                                     surface));
    };
    const Layers one = run(1), four = run(4);
    for (size_t l = 0; l < one.layers.size(); ++l) {
      for (int y = 0; y < 24; ++y) {
        for (int x = 0; x < 24; ++x) {
          ASSERT_EQ(one.layers[l].plane.at(x, y), four.layers[l].plane.at(x, y)) << surface.bsdf;
        }
      }
    }
  }
}

}  // namespace
}  // namespace kiln

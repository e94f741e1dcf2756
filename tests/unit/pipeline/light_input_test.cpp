// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <functional>
#include <limits>
#include <nlohmann/json.hpp>

#include "kiln/image/sphere_image.h"
#include "kiln/io/texture_file.h"
#include "kiln/pipeline/run.h"
#include "support/workshop.h"

namespace kiln {
namespace {

using test::text_of;
using test::Workshop;
using testing::Contains;
using testing::HasSubstr;
using Sky = std::function<Vec3<double>(const Vec3<double>&)>;

/// Bright on one side, and different in every direction.
Vec3<double> sky(const Vec3<double>& d) {
  return {1 + 0.5 * d.x + 0.2 * d.y * d.z, 1 + 0.5 * d.y, 1 + 0.5 * d.z - 0.3 * d.x * d.y};
}

SphereImage filled(SphereImage sphere, const Sky& radiance) {
  for (size_t i = 0; i < sphere.images.size(); ++i) {
    for (int y = 0; y < sphere.size().height; ++y) {
      for (int x = 0; x < sphere.size().width; ++x) {
        const Vec3<double> value = radiance(sample_direction(sphere, static_cast<int>(i), x, y));
        sphere.images[i].layers[0].plane.at(x, y) = static_cast<float>(value.x);
        sphere.images[i].layers[1].plane.at(x, y) = static_cast<float>(value.y);
        sphere.images[i].layers[2].plane.at(x, y) = static_cast<float>(value.z);
      }
    }
  }
  return sphere;
}

Layers blank(Size size) { return make_layers(size, {"R", "G", "B"}); }
SphereImage sky_cube(int n, const Sky& radiance = sky) {
  return filled(cube_image(std::vector<Layers>(6, blank({n, n}))), radiance);
}

void write_float(const Workshop& shop, const std::string& name, const Layers& image) {
  std::filesystem::create_directories((shop / name).parent_path());
  write_image(shop / name, image, {.type = PixelType::Float});
}

void write_faces(const Workshop& shop, const SphereImage& cube, const std::string& before,
                 const std::vector<std::string>& names, const std::string& after) {
  for (size_t f = 0; f < 6; ++f) write_float(shop, before + names[f] + after, cube.images[f]);
}

const std::vector<std::string> short_names = {"px", "nx", "py", "ny", "pz", "nz"};

Layers side_by_side(const SphereImage& cube) {
  const int n = cube.size().width;
  Layers strip = blank({6 * n, n});
  for (int f = 0; f < 6; ++f) {
    for (size_t c = 0; c < 3; ++c) {
      for (int y = 0; y < n; ++y) {
        for (int x = 0; x < n; ++x) {
          strip.layers[c].plane.at(f * n + x, y) =
              cube.images[static_cast<size_t>(f)].layers[c].plane.at(x, y);
        }
      }
    }
  }
  return strip;
}

/// Bakes an environment block into the folder `name`.
Report bake(const Workshop& shop, const std::string& block, const std::string& name = "out") {
  const auto file = shop.write(name + ".yaml", "version: 1\nenvironment: { sky: " + block +
                                                   " }\nbakes: [{ bake: environment, env: sky, "
                                                   "size: 16, layout: latlong, out: env }]\n");
  return run_plan(make_plan(read_pipeline(file), shop / name), Records::None);
}

std::string fault_of(const Report& report) {
  const auto& fault = report.tasks.at(0).fault;
  if (!fault) return "";
  EXPECT_EQ(fault->fault(), Fault::Input);
  return fault->what();
}

/// Mean radiance and harmonics of band 1, which tell how a sky is turned.
std::vector<double> moments(const Workshop& shop, const std::string& name = "out") {
  const auto sh = nlohmann::json::parse(text_of(shop / (name + "/env/sh.json")));
  std::vector<double> found;
  for (size_t i = 0; i < 9; ++i) {
    for (size_t c = 0; c < 3; ++c) found.push_back(sh["radiance"][i][c]);
  }
  return found;
}

void expect_near(const std::vector<double>& a, const std::vector<double>& b, double tolerance) {
  ASSERT_EQ(a.size(), b.size());
  for (size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], tolerance) << i;
}

class LightInput : public testing::Test {
 protected:
  LightInput() {
    write_float(shop, "latlong.exr", filled(latlong_image(blank({64, 32})), sky).images[0]);
    EXPECT_EQ(fault_of(bake(shop, "latlong.exr", "reference")), "");
    expected = moments(shop, "reference");
  }

  void expect_the_sky(const std::string& block, const std::string& note) {
    SCOPED_TRACE(block);
    const Report report = bake(shop, block);
    ASSERT_EQ(fault_of(report), "");
    EXPECT_THAT(report.environments.at(0).notes, Contains(HasSubstr(note)));
    expect_near(moments(shop), expected, 6e-3);
  }

  const Workshop shop;
  std::vector<double> expected;
};

TEST_F(LightInput, IsTheSameSkyFromEveryProjection) {
  write_float(shop, "strip.exr", side_by_side(sky_cube(32)));
  expect_the_sky("strip.exr",
                 "projection cube-strip: six faces px nx py ny pz nz of 32 x 32 (6:1)");
  write_float(shop, "octahedral.exr", filled(octahedral_image(blank({64, 64})), sky).images[0]);
  expect_the_sky("{ path: octahedral.exr, projection: octahedral }",
                 "projection octahedral: 64 x 64");
  write_faces(shop, sky_cube(32), "six/sky_", short_names, ".exr");
  expect_the_sky("{ path: 'six/sky_<FACE>.exr' }",
                 "projection cube-faces: six files sky_<FACE>.exr");
  expect_the_sky("six", "projection cube-faces");
  expect_the_sky("{ path: six, projection: cube-faces }",
                 "px nx py ny pz nz are px nx py ny pz nz");
  write_faces(shop, sky_cube(32), "names/", {"Right", "Left", "Top", "Bottom", "Front", "Back"},
              ".exr");
  expect_the_sky("names", "right left top bottom front back are px nx py ny pz nz");
  write_faces(shop, sky_cube(32), "long/a.", {"PosX", "NegX", "PosY", "NegY", "PosZ", "NegZ"},
              ".exr");
  expect_the_sky("{ path: 'long/a.<FACE>.exr' }", "posx negx posy negy posz negz are");
}

TEST_F(LightInput, MayBeACubeTextureOfAnyContainer) {
  for (const char* name : {"a.ktx2", "a.ktx", "a.dds"}) {
    write_texture(shop / name, {{sky_cube(32).images}}, {.type = PixelType::Float});
    expect_the_sky(name, "projection cube-faces");
    EXPECT_THAT(fault_of(bake(shop, std::string("{ path: ") + name + ", projection: latlong }")),
                HasSubstr("a cube texture, expected one image"));
  }
}

TEST_F(LightInput, MayBeMirroredAndZUp) {
  const auto mirrored = [](const Vec3<double>& d) { return sky({-d.x, d.y, d.z}); };
  const auto z_up = [](const Vec3<double>& d) { return sky({d.x, d.z, -d.y}); };
  write_float(shop, "a.exr", side_by_side(sky_cube(32, mirrored)));
  expect_the_sky("{ path: a.exr, mirror: x }", "mirror x, up y, rotate 0");
  write_float(shop, "b.exr", side_by_side(sky_cube(32, z_up)));
  expect_the_sky("{ path: b.exr, up: z }", "mirror none, up z, rotate 0");
  write_float(shop, "c.exr", filled(latlong_image(blank({64, 32})), mirrored).images[0]);
  expect_the_sky("{ path: c.exr, mirror: x }", "projection latlong: 64 x 32 (2:1)");
  write_float(shop, "d.exr", filled(latlong_image(blank({64, 32})), z_up).images[0]);
  expect_the_sky("{ path: d.exr, up: z }", "up z");
}

TEST_F(LightInput, IsDescribedInWhatIsMadeOfIt) {
  bake(shop, "{ path: latlong.exr, rotate: 30 }");
  const auto env = nlohmann::json::parse(text_of(shop / "out/env/env.json"));
  EXPECT_THAT(env["source"].dump(), HasSubstr("projection latlong: 64 x 32 (2:1)"));
  EXPECT_THAT(env["source"].dump(), HasSubstr("rotate 30"));
}

TEST_F(LightInput, ThatFitsNothingIsRefused) {
  write_float(shop, "square.exr", blank({8, 8}));
  EXPECT_THAT(fault_of(bake(shop, "square.exr")), HasSubstr("square.exr: found 8 x 8, a square"));
  write_float(shop, "odd.exr", blank({17, 8}));
  EXPECT_THAT(fault_of(bake(shop, "odd.exr")), HasSubstr("found 17 x 8, expected 2:1"));
  EXPECT_THAT(fault_of(bake(shop, "{ path: odd.exr, projection: cube-cross }")),
              HasSubstr("found 17 x 8, expected square faces in a cross"));
  EXPECT_THAT(fault_of(bake(shop, "{ path: odd.exr, projection: cube-faces }")),
              HasSubstr("one file, expected six"));
}

TEST_F(LightInput, NamesFacesThatAreMissing) {
  write_faces(shop, sky_cube(4), "six/sky_", short_names, ".exr");
  std::filesystem::remove(shop / "six/sky_ny.exr");
  for (const char* block : {"six", "{ path: 'six/sky_<FACE>.exr' }"}) {
    EXPECT_THAT(fault_of(bake(shop, block)), HasSubstr("missing: ny")) << block;
  }
  EXPECT_THAT(fault_of(bake(shop, "{ path: 'six/cloud_<FACE>.exr' }")), HasSubstr("no such files"));
  shop.write("none/readme.txt", "x");
  EXPECT_THAT(fault_of(bake(shop, "none")), HasSubstr("without a set of six faces"));
}

TEST_F(LightInput, RefusesAFolderOfSeveralSetsAndFacesThatDoNotFit) {
  write_faces(shop, sky_cube(4), "six/a_", short_names, ".exr");
  write_faces(shop, sky_cube(4), "six/b_", short_names, ".exr");
  EXPECT_THAT(fault_of(bake(shop, "six")),
              HasSubstr("2 sets of six faces, a_<FACE>.exr, b_<FACE>"));
  EXPECT_EQ(fault_of(bake(shop, "{ path: 'six/b_<FACE>.exr' }")), "");
  write_float(shop, "six/b_pz.exr", blank({5, 5}));
  EXPECT_THAT(fault_of(bake(shop, "{ path: 'six/b_<FACE>.exr' }")),
              HasSubstr("face pz is 5 x 5, expected 4 x 4"));
  EXPECT_THAT(fault_of(bake(shop, "{ path: 'six/a_<FACE>.exr', projection: latlong }")),
              HasSubstr("six files, expected one image"));
}

TEST_F(LightInput, ThatIsNotFiniteIsRepairedOrRefusedAsAsked) {
  SphereImage cube = sky_cube(8);
  cube.images[3].layers[1].plane.at(5, 2) = std::numeric_limits<float>::quiet_NaN();
  write_float(shop, "nan.exr", side_by_side(cube));
  EXPECT_THAT(fault_of(bake(shop, "{ path: nan.exr, fix: none }")),
              HasSubstr("found 1 NaN and 0 infinite values, the first at (5, 2) of face ny in "
                        "channel G"));
  for (const char* fix : {"zero", "neighbors"}) {
    const Report report = bake(shop, std::string("{ path: nan.exr, fix: ") + fix + " }");
    EXPECT_EQ(fault_of(report), "");
    EXPECT_THAT(report.environments.at(0).warnings, Contains(HasSubstr("1 NaN")));
  }
}

TEST_F(LightInput, ThatIsBlackLightsNothing) {
  const auto black = [](const Vec3<double>&) { return Vec3<double>{}; };
  write_float(shop, "black.exr", blank({32, 16}));
  write_float(shop, "black_cube.exr", side_by_side(sky_cube(8, black)));
  shop.paint_set("set");
  const auto file = shop.write("p.yaml", R"(version: 1
environment: { latlong: black.exr, cube: black_cube.exr }
sets: [{ path: set }]
bakes:
  - { bake: preview, env: latlong, samples: 4, out: latlong.exr }
  - { bake: preview, env: cube, samples: 4, out: cube.exr }
  - { bake: preview, env: cube, mode: split-sum, out: split-sum.exr }
)");
  const Report report = run_plan(make_plan(read_pipeline(file), shop / "p"), Records::None);
  ASSERT_EQ(exit_code(report), 0);
  for (const char* name : {"latlong.exr", "cube.exr", "split-sum.exr"}) {
    const Layers picture = read_image(shop.folder() / "p" / name).image;
    for (const char* channel : {"R", "G", "B"}) {
      for (int y = 0; y < 4; ++y) {
        for (float value : picture.find(channel)->texels_of_row(y)) EXPECT_EQ(value, 0.0f) << name;
      }
    }
  }
}

TEST_F(LightInput, TakesTheColoursOfGreyAndLayeredFiles) {
  Layers grey = make_layers({32, 16}, {"Y"});
  grey.layers[0].plane = Plane(grey.size, 0.25f);
  write_float(shop, "grey.exr", grey);
  EXPECT_EQ(fault_of(bake(shop, "grey.exr")), "");
  EXPECT_NEAR(moments(shop)[2], 0.25 * 2 * std::sqrt(pi), 1e-5);
  Layers layered = make_layers({32, 16}, {"A", "sky.R", "sky.G", "sky.B"});
  for (size_t c = 0; c < 4; ++c)
    layered.layers[c].plane = Plane(layered.size, 0.5f * static_cast<float>(c));
  write_float(shop, "layered.exr", layered);
  EXPECT_EQ(fault_of(bake(shop, "layered.exr")), "");
  EXPECT_NEAR(moments(shop)[2], 1.5 * 2 * std::sqrt(pi), 1e-5);
}

}  // namespace
}  // namespace kiln

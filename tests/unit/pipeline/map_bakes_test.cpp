// SPDX-License-Identifier: Apache-2.0
// Bakes that make maps out of maps, from files to files.
#include <gmock/gmock.h>

#include <cmath>
#include <map>

#include "kiln/bake/pack_layout.h"
#include "kiln/math/hash.h"
#include "kiln/pipeline/run.h"
#include "support/images.h"
#include "support/workshop.h"

namespace kiln {
namespace {

namespace fs = std::filesystem;

using test::narrow_limits;
using test::text_of;
using test::Workshop;
using testing::Contains;
using testing::HasSubstr;
using testing::UnorderedElementsAre;

constexpr Size set_size{45, 150};

// Codes of so many values, one for each texel, hashed; rolled by columns and rows.
Layers hashed_map(const std::vector<std::string>& names, uint32_t seed, uint32_t codes,
                  int roll = 0) {
  Layers image = make_layers(set_size, names);
  for (Layer& layer : image.layers) {
    ++seed;
    for (int y = 0; y < set_size.height; ++y) {
      for (int x = 0; x < set_size.width; ++x) {
        const int from_x = (x + roll) % set_size.width, from_y = (y + 2 * roll) % set_size.height;
        const uint32_t bits =
            combine_hash(seed, static_cast<uint32_t>(from_y * set_size.width + from_x));
        layer.plane.at(x, y) = static_cast<float>(bits % codes) / static_cast<float>(codes - 1);
      }
    }
  }
  return image;
}

void paint(const Workshop& shop, const std::string& name, const Layers& image,
           PixelType type = PixelType::Uint8) {
  fs::create_directories((shop / name).parent_path());
  write_image(shop / name, image, {.type = type});
}

void paint_set(const Workshop& shop, const std::string& folder = "rock", int roll = 0) {
  const auto numbers = [&](uint32_t seed) { return hashed_map({"Y"}, seed, 256, roll); };
  paint(shop, folder + "/x_BaseColor.png", hashed_map({"R", "G", "B"}, 10, 256, roll));
  paint(shop, folder + "/x_Roughness.png", numbers(20));
  paint(shop, folder + "/x_Metallic.png", numbers(30));
  paint(shop, folder + "/x_AmbientOcclusion.png", numbers(40));
  paint(shop, folder + "/x_NormalGL.png", hashed_map({"R", "G", "B"}, 50, 256, roll));
  paint(shop, folder + "/x_Height.png", numbers(60));
}

Report run(const Workshop& shop, const std::string& bake, const std::string& set = "rock",
           const std::string& more = "") {
  const std::string text = "version: 1\n" + more + "sets: [{ path: " + set +
                           ", name: rock }]\nbakes:\n  - { " + bake + " }\n";
  return run_plan(make_plan(read_pipeline(shop.write("p.yaml", text)), shop / "out"),
                  Records::Keep);
}

void expect_baked(const Report& report) {
  for (const TaskRecord& task : report.tasks) {
    EXPECT_FALSE(task.fault) << (task.fault ? task.fault->what() : "");
  }
}

std::string fault_of(const Report& report) {
  return report.tasks.at(0).fault ? report.tasks.at(0).fault->what() : "";
}

Plane plane_of(const fs::path& path, const std::string& channel) {
  return *read_image(path).image.find(channel);
}

void expect_equal(const Plane& a, const Plane& b, float tolerance = 0) {
  ASSERT_EQ(a.size(), b.size());
  for (int y = 0; y < a.height(); ++y) {
    for (int x = 0; x < a.width(); ++x) ASSERT_NEAR(a.at(x, y), b.at(x, y), tolerance) << x << y;
  }
}

TEST(Packing, PutsEveryCodeWhereTheLayoutSaysAndUnpackingBringsItBack) {
  const Workshop shop;
  paint_set(shop);
  const Report packed = run(shop, "bake: pack, preset: unreal, out: \"T_{set}_{suffix}.png\"");
  expect_baked(packed);
  EXPECT_THAT(packed.tasks[0].outputs,
              UnorderedElementsAre("T_rock_BC.png", "T_rock_ORM.png", "T_rock_N.png"));
  expect_equal(plane_of(shop / "out/T_rock_ORM.png", "G"),
               plane_of(shop / "rock/x_Roughness.png", "Y"));
  expect_equal(plane_of(shop / "out/T_rock_BC.png", "B"),
               plane_of(shop / "rock/x_BaseColor.png", "B"));
  EXPECT_EQ(read_image(shop / "out/T_rock_ORM.png").facts.type, PixelType::Uint8);
  fs::create_directories(shop / "packed");
  fs::copy(shop / "out/T_rock_ORM.png", shop / "packed/rock_ORM.png");
  expect_baked(run(shop, "bake: unpack, out: apart", "packed"));
  for (const auto& [slot, map] :
       {std::pair{"ambient_occlusion", "AmbientOcclusion"}, std::pair{"roughness", "Roughness"},
        std::pair{"metallic", "Metallic"}}) {
    expect_equal(plane_of(shop / ("out/apart/" + std::string(slot) + ".png"), "Y"),
                 plane_of(shop / ("rock/x_" + std::string(map) + ".png"), "Y"));
  }
}

TEST(Packing, TurnsGreenForEnginesWhoseNormalsPointDown) {
  const Workshop shop;
  paint_set(shop);
  expect_baked(run(shop, "bake: pack, preset: unreal, out: u"));
  const Plane green = plane_of(shop / "out/u/N.png", "G");
  const Plane stored = plane_of(shop / "rock/x_NormalGL.png", "G");
  for (int x = 0; x < set_size.width; ++x) {
    EXPECT_EQ(std::lround(255 * green.at(x, 7)), 255 - std::lround(255 * stored.at(x, 7)));
  }
  expect_equal(plane_of(shop / "out/u/N.png", "R"), plane_of(shop / "rock/x_NormalGL.png", "R"));
}

TEST(Packing, KeepsSmoothnessInAlphaAndColourUnderIt) {
  const Workshop shop;
  paint_set(shop);
  const Report report = run(shop, "bake: pack, preset: unity-hdrp, out: u");
  expect_baked(report);
  const Plane smooth = plane_of(shop / "out/u/MaskMap.png", "A");
  const Plane rough = plane_of(shop / "rock/x_Roughness.png", "Y");
  for (int x = 0; x < set_size.width; ++x) {
    EXPECT_EQ(std::lround(255 * smooth.at(x, 149)), 255 - std::lround(255 * rough.at(x, 149)));
  }
  expect_equal(plane_of(shop / "out/u/MaskMap.png", "R"),
               plane_of(shop / "rock/x_Metallic.png", "Y"));
}

TEST(Packing, TakesTheWidestTypeAndSaysWhichConstantsStandIn) {
  const Workshop shop;
  paint(shop, "rock/x_Roughness.png", hashed_map({"Y"}, 1, 65536), PixelType::Uint16);
  const Report report = run(shop, "bake: pack, preset: gltf, out: g");
  expect_baked(report);
  EXPECT_EQ(read_image(shop / "out/g/metallicRoughness.png").facts.type, PixelType::Uint16);
  expect_equal(plane_of(shop / "out/g/metallicRoughness.png", "G"),
               plane_of(shop / "rock/x_Roughness.png", "Y"));
  EXPECT_THAT(report.tasks[0].notes,
              Contains("metallicRoughness.b: no map for metallic, constant 0"));
  EXPECT_THAT(report.tasks[0].notes, Contains("normal: not made, none of its maps is given"));
}

TEST(Packing, PassesNumbersThroughThatAreTaggedAsColour) {
  const Workshop shop;
  const Layers rough = hashed_map({"Y"}, 1, 256);
  fs::create_directories(shop / "rock");
  write_image(shop / "rock/x_Roughness.png", rough,
              {.type = PixelType::Uint8, .color_tag = ColorTag::Srgb});
  expect_baked(run(shop, "bake: pack, layout: \"r = roughness\", out: r"));
  expect_equal(plane_of(shop / "out/r/r.png", "Y"), rough.layers[0].plane, 1e-7f);
}

// The file that a slot was painted in, or its opposite's.
std::string painted(const std::string& slot) {
  const std::map<std::string, std::string> names{
      {"base_color", "BaseColor"}, {"diffuse", "BaseColor"},
      {"roughness", "Roughness"},  {"gloss", "Roughness"},
      {"metallic", "Metallic"},    {"ambient_occlusion", "AmbientOcclusion"},
      {"normal", "NormalGL"},      {"height", "Height"}};
  const auto found = names.find(slot);
  return found == names.end() ? "" : "rock/x_" + found->second + ".png";
}

int code(float value) { return static_cast<int>(std::lround(255 * value)); }

TEST(Packing, ComesBackBitForBitFromALoneFileOfEveryPreset) {
  const Workshop shop;
  paint_set(shop);
  for (const std::string& preset : pack_preset_names()) {
    const Report packed = run(shop, "bake: pack, preset: " + preset + ", out: " + preset);
    expect_baked(packed);
    for (const std::string& file : packed.tasks[0].outputs) {
      const Report apart =
          run(shop, "bake: unpack, out: apart/" + preset + "_" + fs::path(file).stem().string(),
              "out/" + file + ", packed: " + preset);
      expect_baked(apart);
      for (const std::string& output : apart.tasks[0].outputs) {
        const std::string slot = fs::path(output).stem().string(), source = painted(slot);
        if (source.empty()) continue;
        const Layers back = read_image(shop / ("out/" + output)).image;
        const Layers stored = read_image(shop / source).image;
        ASSERT_EQ(back.layers.size(), stored.layers.size()) << output;
        for (size_t c = 0; c < back.layers.size(); ++c) {
          const bool turned = slot == "gloss" || (slot == "normal" && preset == "unreal" && c == 1);
          for (int x = 0; x < set_size.width; ++x) {
            const int was = code(stored.layers[c].plane.at(x, 71));
            ASSERT_EQ(code(back.layers[c].plane.at(x, 71)), turned ? 255 - was : was) << output;
          }
        }
      }
    }
  }
}

TEST(Packing, OfALoneFileTakesTheLayoutOfItsNameOrTheOnlyOne) {
  const Workshop shop;
  paint_set(shop);
  expect_baked(run(shop, "bake: pack, layout: \"m = metallic, 1 - height, 0.5\", out: m"));
  const Report named = run(shop, "bake: unpack, out: a",
                           "out/m/m.png, packed: \"other = roughness; m = metallic, 1 - height\"");
  expect_baked(named);
  EXPECT_THAT(named.tasks[0].outputs, UnorderedElementsAre("a/metallic.png", "a/height.png"));
  expect_equal(plane_of(shop / "out/a/height.png", "Y"), plane_of(shop / "rock/x_Height.png", "Y"));
  const Report only = run(shop, "bake: unpack, out: b", "out/m/m.png, packed: \"x = opacity\"");
  expect_baked(only);
  EXPECT_THAT(only.tasks[0].outputs, UnorderedElementsAre("b/opacity.png"));
}

TEST(Packing, OfALoneFileSaysWhatItDoesNotUnderstand) {
  const Workshop shop;
  paint_set(shop);
  const auto refusal = [&](const std::string& packed) {
    return test::message_of([&] { run(shop, "bake: unpack, out: a", packed); });
  };
  const std::string image = "rock/x_Roughness.png, packed: ";
  EXPECT_THAT(refusal(image + "unrel"), HasSubstr("did you mean 'unreal'"));
  EXPECT_THAT(refusal(image + "unreal"), HasSubstr("ends in no file of the layout: BC, ORM, N, E"));
  EXPECT_THAT(refusal(image + "\"a = base_color.b\""), HasSubstr("expected 'rgb'"));
  EXPECT_THAT(refusal(image + "\"a = metallic, metallic\""), HasSubstr("metallic twice"));
  EXPECT_THAT(refusal(image + "\"a = 0.5\""), HasSubstr("holds no map"));
  EXPECT_THAT(refusal("rock, packed: unreal"), HasSubstr("is no image"));
}

TEST(Packing, RefusesOneNameForSeveralFiles) {
  const Workshop shop;
  paint_set(shop);
  EXPECT_THAT(fault_of(run(shop, "bake: pack, out: one.png")), HasSubstr("{suffix}"));
}

TEST(MapBakes, MakeTheSameBytesForEveryMemoryBudget) {
  const Workshop shop;
  paint_set(shop);
  const std::string bake = "bake: derive, quantities: \"f0,alpha,directional_albedo\", out: ";
  expect_baked(run(shop, bake + "wide"));
  expect_baked(run(shop, bake + "narrow", "rock", narrow_limits));
  for (const char* name : {"f0.exr", "alpha.exr", "directional_albedo_60.exr"}) {
    EXPECT_EQ(text_of(shop / "out/wide" / name), text_of(shop / "out/narrow" / name)) << name;
    EXPECT_FALSE(text_of(shop / "out/wide" / name).empty());
  }
}

TEST(MapBakes, RefuseABudgetThatHoldsNoBand) {
  const Workshop shop;
  paint_set(shop);
  const Report report = run(shop, "bake: pack, out: p", "rock", "limits: { memory: 1MiB }\n");
  EXPECT_THAT(fault_of(report), HasSubstr("a band of 16 rows needs"));
  EXPECT_EQ(exit_code(report), 33);
  EXPECT_FALSE(fs::exists(shop / "out/p/metallicRoughness.png"));
}

TEST(MapBakes, RefuseMapsOfOtherAspectsUnlessTheyAreNotRead) {
  const Workshop shop;
  shop.paint("odd/x_BaseColor.png", 0.5f, PixelType::Uint8, {8, 8});
  shop.paint("odd/x_Roughness.png", 0.5f, PixelType::Uint8, {8, 4});
  for (const char* bake : {"pack", "mips", "derive", "convert, to: spec-gloss"}) {
    const Report report = run(shop, std::string("bake: ") + bake + ", out: o", "odd");
    EXPECT_THAT(fault_of(report), HasSubstr("base_color x_BaseColor.png (8x8) and roughness "
                                            "x_Roughness.png (8x4) cannot belong together"));
    EXPECT_EQ(report.tasks[0].fault->fault(), Fault::Input);
  }
  expect_baked(run(shop, "bake: mips, map: base_color, out: \"{suffix}.exr\"", "odd"));
}

TEST(MapBakes, TellOfMapsThatTheWorkflowDoesNotRead) {
  const Workshop shop;
  paint_set(shop);
  for (const char* map : {"Emissive", "Glossiness"}) {
    shop.paint(std::string("rock/x_") + map + ".png", 0.5f, PixelType::Uint8);
  }
  const Report report = run(shop, "bake: derive, quantities: f0, out: d");
  expect_baked(report);
  EXPECT_THAT(report.sets.at(0).notes, Contains("emissive: not rendered, ignored"));
  EXPECT_THAT(report.sets.at(0).notes, Contains("gloss: not read by metal-rough"));
}

TEST(MapBakes, RollWithTheirInput) {
  const Workshop shop;
  constexpr int roll = 13;
  paint_set(shop, "rock");
  paint_set(shop, "rolled", roll);
  const auto bake = [&](const std::string& set) {
    expect_baked(run(shop, "bake: normal, from: height, out: " + set + "_h.exr", set));
    expect_baked(run(shop, "bake: derive, quantities: f0, out: " + set + "_d", set));
  };
  bake("rock");
  bake("rolled");
  for (const std::string name : {"_h.exr", "_d/f0.exr"}) {
    const Plane plain = plane_of(shop / ("out/rock" + name), "G");
    const Plane rolled = plane_of(shop / ("out/rolled" + name), "G");
    for (int y = 0; y < set_size.height; ++y) {
      for (int x = 0; x < set_size.width; ++x) {
        ASSERT_EQ(rolled.at(x, y),
                  plain.at((x + roll) % set_size.width, (y + 2 * roll) % set_size.height));
      }
    }
  }
}

TEST(Deriving, GivesWhatTheWorkflowAndTheLobeSay) {
  const Workshop shop;
  const auto constant = [](float value) {
    Layers image = make_layers({8, 8}, {"Y"});
    for (int y = 0; y < 8; ++y) std::fill_n(image.layers[0].plane.row(y), 8, value);
    return image;
  };
  paint(shop, "rock/x_Roughness.exr", constant(0.5f), PixelType::Float);
  paint(shop, "rock/x_Metallic.exr", constant(0.0f), PixelType::Float);
  expect_baked(run(shop, "bake: derive, angles: \"0\", type: float, out: d"));
  EXPECT_FLOAT_EQ(plane_of(shop / "out/d/f0.exr", "R").at(3, 3), 0.04f);
  EXPECT_FLOAT_EQ(plane_of(shop / "out/d/alpha.exr", "Y").at(3, 3), 0.25f);
  // 0.04 A + B, from the exact integrals at normal incidence and roughness 0.5.
  const double exact = 0.04 * 0.91578505932332432 + 2.7370926425609106e-05;
  EXPECT_NEAR(plane_of(shop / "out/d/directional_albedo_0.exr", "R").at(3, 3), exact, 2e-5);
}

TEST(Converting, GoesToSpecularGlossinessAndBackToTheSameSurface) {
  const Workshop shop;
  paint_set(shop);
  expect_baked(run(shop, "bake: convert, to: spec-gloss, format: exr, type: float, out: sg"));
  const std::string maps =
      "version: 1\nsets: [{ name: rock, workflow: spec-gloss, maps: { diffuse: out/sg/diffuse.exr, "
      "specular_color: out/sg/specular_color.exr, gloss: out/sg/gloss.exr } }]\nbakes:\n"
      "  - { bake: convert, to: metal-rough, format: exr, type: float, out: mr }\n"
      "  - { bake: derive, quantities: \"f0,diffuse_albedo\", type: float, out: of_sg }\n";
  expect_baked(run_plan(make_plan(read_pipeline(shop.write("back.yaml", maps)), shop / "out"),
                        Records::None));
  const std::string again =
      "version: 1\nsets: [{ name: rock, workflow: metal-rough, maps: { base_color: "
      "out/mr/base_color.exr, metallic: out/mr/metallic.exr, roughness: out/mr/roughness.exr } }]\n"
      "bakes:\n  - { bake: derive, quantities: \"f0,diffuse_albedo\", type: float, out: of_mr }\n";
  expect_baked(run_plan(make_plan(read_pipeline(shop.write("again.yaml", again)), shop / "out"),
                        Records::None));
  // Hashed colours and metalness have hues that one metalness cannot give back; what a surface
  // reflects in all still agrees on average.
  double apart = 0, count = 0;
  for (const char* channel : {"R", "G", "B"}) {
    const Plane f0_a = plane_of(shop / "out/of_sg/f0.exr", channel);
    const Plane f0_b = plane_of(shop / "out/of_mr/f0.exr", channel);
    const Plane diffuse_a = plane_of(shop / "out/of_sg/diffuse_albedo.exr", channel);
    const Plane diffuse_b = plane_of(shop / "out/of_mr/diffuse_albedo.exr", channel);
    for (int y = 0; y < set_size.height; ++y) {
      for (int x = 0; x < set_size.width; ++x) {
        const double error =
            (f0_a.at(x, y) + diffuse_a.at(x, y)) - (f0_b.at(x, y) + diffuse_b.at(x, y));
        apart += error * error;
        count += 1;
      }
    }
  }
  EXPECT_LT(std::sqrt(apart / count), 0.02);
}

// Runs a bake on the set of a material file.
void run_material(const Workshop& shop, const fs::path& file, const std::string& bake) {
  MaterialFile material = read_material_file(file);
  Pipeline pipeline = read_pipeline(
      shop.write("m.yaml", "version: 1\nsets: [{ path: . }]\nbakes: [{ " + bake + " }]\n"));
  pipeline.sets = {material.set};
  pipeline.material = material.material;
  expect_baked(run_plan(make_plan(pipeline, shop / "out"), Records::None));
}

double difference_of(const fs::path& a, const fs::path& b) {
  return test::greatest_difference(read_image(a).image, read_image(b).image);
}

// Half a code of sRGB is 0.0045 near white, and half a code of roughness 0.004 of alpha; half a
// code of metalness moves by less.
constexpr double within_codes = 0.0065;

void expect_same_surface(const fs::path& a, const fs::path& b, const std::string& which) {
  for (const char* name : {"f0.exr", "diffuse_albedo.exr", "alpha.exr"}) {
    EXPECT_LT(difference_of(a / name, b / name), within_codes) << which << " " << name;
  }
}

TEST(Converting, WritesAMaterialFileThatReadsItBack) {
  const Workshop shop;
  paint_set(shop);
  fs::rename(shop / "rock/x_NormalGL.png", shop / "rock/x_NormalDX.png");
  const std::string derive = "bake: derive, quantities: \"f0,diffuse_albedo,alpha\", type: float";
  const std::string normal = "bake: normal, to: gl, type: uint16";
  expect_baked(run(shop, derive + ", out: given"));
  expect_baked(run(shop, normal + ", out: given/n.png"));
  // What one metalness cannot hold is lost before anything is stored: the same in floats is the
  // measure.
  expect_baked(run(shop, "bake: convert, format: exr, type: float, out: floats"));
  run_material(shop, shop / "out/floats/material.yaml", derive + ", out: of_floats");
  for (const std::string way : {"spec-gloss", "albedo-specular-roughness",
                                "metal-rough, method: lossless", "metal-rough"}) {
    const std::string to = "to_" + std::to_string(way.size());
    const Report report = run(shop, "bake: convert, to: " + way + ", out: " + to);
    expect_baked(report);
    EXPECT_THAT(report.tasks[0].outputs, Contains(to + "/material.yaml"));
    const fs::path material = shop / ("out/" + to + "/material.yaml");
    run_material(shop, material, derive + ", out: back_" + to);
    run_material(shop, material, normal + ", out: " + to + "_n.png");
    expect_same_surface(shop / (way == "metal-rough" ? "out/of_floats" : "out/given"),
                        shop / ("out/back_" + to), way);
    EXPECT_EQ(difference_of(shop / "out/given/n.png", shop / ("out/" + to + "_n.png")), 0);
  }
}

TEST(Converting, NamesItsMaterialFileLikeItsMapsAndPassesOthersThrough) {
  const Workshop shop;
  paint_set(shop);
  const std::string set = "rock, normal_zero: 127, wrap: clamp, alpha_cutoff: 0.25";
  const Report report =
      run(shop, "bake: convert, to: spec-gloss, out: \"T_{set}_{suffix}.png\"", set);
  expect_baked(report);
  EXPECT_THAT(report.tasks[0].outputs, Contains("T_rock_material.yaml"));
  const std::string text = text_of(shop / "out/T_rock_material.yaml");
  EXPECT_THAT(
      text, HasSubstr("workflow: spec-gloss\nalpha_cutoff: 0.25\nnormal_zero: 127\nwrap: clamp\n"));
  EXPECT_THAT(text, HasSubstr("diffuse: { path: \"T_rock_diffuse.png\", color_space: "
                              "\"srgb_rec709_scene\" }"));
  EXPECT_THAT(text, HasSubstr("gloss: { path: \"T_rock_gloss.png\" }"));
  EXPECT_THAT(text, HasSubstr("normal: { path: \"../rock/x_NormalGL.png\", channel: rgb, "
                              "convention: gl }"));
  EXPECT_THAT(text, HasSubstr("height: { path: \"../rock/x_Height.png\", channel: r }"));
  EXPECT_THAT(text, testing::Not(HasSubstr("metallic")));
}

TEST(Converting, KeepsAnisotropyAsItsLobeHasIt) {
  const Workshop shop;
  const std::string maps =
      "version: 1\nsets: [{ name: rock, workflow: metal-rough, maps: { roughness: r.png, metallic: "
      "{ value: 1 }, anisotropy: { path: a.png, encoding: gltf }, anisotropy_angle: { value: 0.1 } "
      "} }]\nbakes:\n  - { bake: convert, to: spec-gloss, type: float, format: exr, out: sg }\n"
      "  - { bake: derive, quantities: directional_albedo, angles: 60, type: float, out: given }\n";
  paint(shop, "r.png", hashed_map({"Y"}, 1, 256));
  paint(shop, "a.png", hashed_map({"Y"}, 2, 256));
  expect_baked(
      run_plan(make_plan(read_pipeline(shop.write("p.yaml", maps)), shop / "out"), Records::None));
  EXPECT_THAT(text_of(shop / "out/sg/material.yaml"),
              HasSubstr("anisotropy: { path: \"anisotropy.exr\", encoding: burley }"));
  run_material(shop, shop / "out/sg/material.yaml",
               "bake: derive, quantities: directional_albedo, angles: 60, type: float, out: back");
  EXPECT_LT(difference_of(shop / "out/given/directional_albedo_60.exr",
                          shop / "out/back/directional_albedo_60.exr"),
            1e-5);
}

TEST(Normals, TurnBitForBitAndBack) {
  const Workshop shop;
  paint_set(shop);
  expect_baked(run(shop, "bake: normal, to: dx, out: n_dx.png"));
  fs::create_directories(shop / "dx");
  fs::copy(shop / "out/n_dx.png", shop / "dx/x_NormalDX.png");
  expect_baked(run(shop, "bake: normal, to: gl, out: n_gl.png", "dx"));
  for (const char* channel : {"R", "G", "B"}) {
    expect_equal(plane_of(shop / "out/n_gl.png", channel),
                 plane_of(shop / "rock/x_NormalGL.png", channel));
  }
}

TEST(Normals, OfARampOfHeightAreItsSlope) {
  const Workshop shop;
  Layers ramp = make_layers({64, 64}, {"Y"});
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) ramp.layers[0].plane.at(x, y) = static_cast<float>(y) / 64;
  }
  paint(shop, "rock/x_Height.exr", ramp, PixelType::Float);
  paint(shop, "rock/x_Roughness.exr", ramp, PixelType::Float);
  expect_baked(run(shop,
                   "bake: normal, from: height, height_scale: 0.5, tile_size: 1, format: exr, "
                   "type: float, out: n.exr"));
  // Height falls by 0.5 m over 1 m going up the image: the normal leans up by that slope.
  const double up = 0.5 / std::sqrt(1.25);
  EXPECT_NEAR(2 * plane_of(shop / "out/n.exr", "G").at(20, 30) - 1, up, 1e-5);
  EXPECT_NEAR(2 * plane_of(shop / "out/n.exr", "R").at(20, 30) - 1, 0, 1e-6);
}

}  // namespace
}  // namespace kiln

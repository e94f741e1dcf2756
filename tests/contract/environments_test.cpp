// SPDX-License-Identifier: Apache-2.0
// Every file format, every engine's layout and every curve of environments: written by the
// command's own path and read back.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "kiln/bake/environment.h"
#include "kiln/image/projection.h"
#include "kiln/io/texture_file.h"
#include "kiln/pipeline/pipeline.h"
#include "kiln/pipeline/run.h"
#include "support/workshop.h"

namespace kiln {
namespace {

using test::Workshop;

std::string fact_of(const NamedText& item, const std::string& wanted) {
  for (const auto& [name, text] : item.facts) {
    if (name == wanted) return text;
  }
  return "";
}

std::vector<std::string> words_of(const std::string& text) {
  std::vector<std::string> words;
  for (size_t begin = 0; begin < text.size();) {
    const size_t end = std::min(text.find(", ", begin), text.size());
    words.push_back(text.substr(begin, end - begin));
    begin = end + 2;
  }
  return words;
}

/// A dim room with a window at +X and a lamp above.
std::filesystem::path paint_room(const Workshop& shop) {
  Layers image = make_layers({64, 32}, {"R", "G", "B"});
  for (int y = 0; y < 32; ++y) {
    for (int x = 0; x < 64; ++x) {
      image.layers[0].plane.at(x, y) = x / 4 == 4 && y / 4 == 4 ? 8.0f : 0.25f;
      image.layers[1].plane.at(x, y) = 0.5f;
      image.layers[2].plane.at(x, y) = y < 2 ? 20.0f : 0.125f;
    }
  }
  const std::filesystem::path path = shop / "room.exr";
  write_image(path, image, {PixelType::Float, {}});
  return path;
}

using Settings = std::vector<std::pair<std::string, std::string>>;

Report bake_environment(const Workshop& shop, const Settings& settings) {
  std::string text =
      "version: 1\nenvironment: { room: room.exr }\nbakes:\n  - { bake: environment, "
      "env: room, size: 32, out: env";
  for (const auto& [name, value] : settings) text += ", " + name + ": \"" + value + "\"";
  paint_room(shop);
  const Pipeline pipeline = read_pipeline(shop.write("env.yaml", text + " }\n"));
  return run_plan(make_plan(pipeline, shop / "out"), Records::None, {});
}

void expect_baked(const Report& report) {
  ASSERT_EQ(report.tasks.size(), 1u);
  ASSERT_FALSE(report.tasks[0].fault) << report.tasks[0].fault->what();
}

// Formats of Babylon.js want all levels.
Settings settings_for(const std::string& format) {
  Settings settings = {{"format", format}};
  if (format == "env") settings.emplace_back("curve", "babylon");
  return settings;
}

TEST(EnvironmentFormats, HoldEveryEncodingThatTheyList) {
  for (const NamedText& format : list_environment_formats()) {
    for (const std::string& encoding : words_of(fact_of(format, "encodings"))) {
      const Workshop shop;
      Settings settings = settings_for(format.name);
      settings.emplace_back("encoding", encoding);
      const Report report = bake_environment(shop, settings);
      expect_baked(report);
      const auto env = nlohmann::json::parse(test::text_of(shop / "out/env/env.json"));
      EXPECT_EQ(env["encoding"], encoding);
      EXPECT_LT(env["error"]["encoding"]["rms"], 0.05) << format.name << " " << encoding;
      EXPECT_EQ(env["fixed"]["clamped"], 0) << format.name << " " << encoding;
    }
  }
}

TEST(EnvironmentFormats, AreReadBackWithAllLevelsAndFaces) {
  for (const NamedText& format : list_environment_formats()) {
    const Workshop shop;
    const Report report = bake_environment(shop, settings_for(format.name));
    expect_baked(report);
    const auto env = nlohmann::json::parse(test::text_of(shop / "out/env/env.json"));
    const std::string extension = fact_of(format, "extension");
    const auto whole = shop / ("out/env/specular" + extension);
    if (!std::filesystem::exists(whole)) {
      for (size_t level = 0; level < env["roughness"].size(); ++level) {
        const auto path = shop / ("out/env/specular_m" + std::to_string(level) + "_pz" + extension);
        EXPECT_EQ(read_image(path).facts.size.width, 32 >> level) << path;
      }
      continue;
    }
    const TextureFile file = read_texture(whole);
    ASSERT_TRUE(file.texture.is_cube()) << format.name;
    EXPECT_GE(file.texture.levels.size(), env["roughness"].size()) << format.name;
    const auto green = [&](size_t level, CubeFace face, int x, int y) {
      return file.texture.levels[level][static_cast<size_t>(face)].layers[1].plane.at(x, y);
    };
    EXPECT_NEAR(green(0, CubeFace::nz, 3, 20), 0.5, 0.01) << format.name;
    const Plane& lit = file.texture.levels[0][static_cast<size_t>(CubeFace::px)].layers[0].plane;
    EXPECT_NEAR(lit.at(12, 18), 8, 1) << format.name;
  }
}

TEST(EnvironmentPresets, MakeWhatTheyList) {
  for (const NamedText& preset : list_environment_presets()) {
    const Workshop shop;
    const Report report = bake_environment(shop, {{"preset", preset.name}});
    expect_baked(report);
    for (const std::string& name : words_of(fact_of(preset, "files"))) {
      const bool made =
          std::any_of(report.tasks[0].outputs.begin(), report.tasks[0].outputs.end(),
                      [&](const std::string& output) { return output.starts_with("env/" + name); });
      // Babylon.js keeps irradiance inside the one file.
      EXPECT_TRUE(made || (preset.name == "babylon" && name == "irradiance"))
          << preset.name << name;
    }
    const auto env = nlohmann::json::parse(test::text_of(shop / "out/env/env.json"));
    for (const char* key : {"format", "encoding", "curve", "layout", "axes"}) {
      const std::string wanted = fact_of(preset, key);
      if (!wanted.empty()) {
        EXPECT_EQ(env[key], wanted) << preset.name;
      }
    }
  }
}

TEST(EnvironmentPresets, MirrorForLeftHandedEngines) {
  const Workshop shop;
  expect_baked(bake_environment(shop, {{"preset", "unity"}}));
  const TextureFile file = read_texture(shop / "out/env/specular.dds");
  // The window is at kiln's +X, which is Unity's -X.
  const auto red = [&](CubeFace face) {
    return file.texture.levels[0][static_cast<size_t>(face)].layers[0].plane.at(
        face == CubeFace::nx ? 19 : 12, 18);
  };
  EXPECT_GT(red(CubeFace::nx), 6);
  EXPECT_NEAR(red(CubeFace::px), 0.25, 0.01);
}

TEST(EnvironmentPresets, KeepTheIrradianceThatEnginesRead) {
  const Workshop shop;
  expect_baked(bake_environment(shop, {{"preset", "babylon"}}));
  const TextureFile file = read_texture(shop / "out/env/environment.env");
  ASSERT_TRUE(file.irradiance);
  const auto sh = nlohmann::json::parse(test::text_of(shop / "out/env/sh.json"))["shader"]["c"];
  // Along +Y the polynomial is c0 + c1 - c6 - c8.
  const double expected = double(sh[0][2]) + double(sh[1][2]) - double(sh[6][2]) - double(sh[8][2]);
  EXPECT_NEAR(file.irradiance->y[2] + file.irradiance->yy[2], expected, 1e-6);
}

TEST(EnvironmentCurves, AllMakeAChain) {
  for (const NamedText& curve : list_roughness_curves()) {
    const Workshop shop;
    expect_baked(bake_environment(shop, {{"curve", curve.name}, {"format", "ktx2"}}));
    const auto env = nlohmann::json::parse(test::text_of(shop / "out/env/env.json"));
    for (const double error : env["error"]["levels"]) EXPECT_LT(error, 1e-3) << curve.name;
  }
}

TEST(EnvironmentLayouts, AllMakeAChain) {
  for (const char* layout : {"cube", "latlong", "octahedral"}) {
    for (const char* format : {"exr", "ktx2"}) {
      const Workshop shop;
      expect_baked(bake_environment(shop, {{"layout", layout}, {"format", format}}));
      const auto env = nlohmann::json::parse(test::text_of(shop / "out/env/env.json"));
      for (const double error : env["error"]["levels"]) EXPECT_LT(error, 1e-3) << layout;
    }
  }
}

TEST(EnvironmentFormats, SayWhatTheyClamp) {
  const Workshop shop;
  Layers image = make_layers({64, 32}, {"R", "G", "B"});
  for (Layer& layer : image.layers) layer.plane = Plane(image.size, 1.0f);
  for (Layer& layer : image.layers) layer.plane.at(16, 16) = 4e5f;
  write_image(shop / "sun.exr", image, {PixelType::Float, {}});
  const auto bake = [&](const std::string& encoding) {
    const Pipeline pipeline =
        read_pipeline(shop.write("env.yaml",
                                 "version: 1\nenvironment: { sun: sun.exr }\nbakes: [ { bake: "
                                 "environment, env: sun, size: 32, format: ktx2, encoding: " +
                                     encoding + ", out: env } ]\n"));
    expect_baked(run_plan(make_plan(pipeline, shop / "out"), Records::None, {}));
    return nlohmann::json::parse(test::text_of(shop / "out/env/env.json"))["fixed"];
  };
  const auto half = bake("half"), whole = bake("float");
  EXPECT_GT(half["clamped"], 0);
  EXPECT_GT(half["lost_energy"], 0.1);
  EXPECT_LT(half["lost_energy"], 1);
  EXPECT_EQ(whole["clamped"], 0);
  EXPECT_EQ(whole["lost_energy"], 0);
}

TEST(EnvironmentSettings, ThatDoNotFitAreRefusedBeforeAnythingRuns) {
  const std::vector<Settings> wrong = {
      {{"format", "hdr"}, {"encoding", "half"}},
      {{"format", "env"}, {"curve", "linear"}},
      {{"format", "env"}, {"curve", "babylon"}, {"layout", "latlong"}},
      {{"format", "exr"}, {"supercompression", "zstd"}},
      {{"layout", "latlong"}, {"axes", "-x,y,z"}},
      {{"layout", "octahedral"}, {"format", "exr-mip"}},
      {{"curve", "0,0.01,1"}},
      {{"curve", "filamnet"}},
      {{"axes", "x,y"}},
      {{"preset", "unitty"}},
      {{"distribution", "gxg"}}};
  for (const Settings& settings : wrong) {
    const Workshop shop;
    EXPECT_THROW(bake_environment(shop, settings), Error) << settings[0].second;
    EXPECT_FALSE(std::filesystem::exists(shop / "out"));
  }
}

}  // namespace
}  // namespace kiln

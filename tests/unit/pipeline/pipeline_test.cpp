// SPDX-License-Identifier: Apache-2.0
#include "kiln/pipeline/pipeline.h"

#include <gmock/gmock.h>

#include "support/workshop.h"

namespace kiln {
namespace {

using test::error_of;
using test::message_of;
using test::Workshop;
using testing::HasSubstr;

TEST(PipelineFile, ResolvesPathsAgainstItsOwnFolder) {
  const Workshop shop;
  const auto file =
      shop.write("p/rocks.yaml",
                 "version: 1\nvars: { t: ../tex }\nenvironment: { sky: \"{t}/sky.exr\" }\n"
                 "sets: [{ glob: \"{t}/*/\" }]\nbakes: []\n");
  const Pipeline pipeline = read_pipeline(file);
  EXPECT_EQ(pipeline.environments.at(0).path, shop / "tex/sky.exr");
  EXPECT_EQ(pipeline.sets.at(0).glob, (shop / "tex/*/").string());
}

TEST(PipelineFile, TakesVariablesFromTheCommandLineOverItsOwn) {
  const Workshop shop;
  const auto file = shop.write("a.yaml", "version: 1\nvars: { n: a }\nname: \"{n}\"\nbakes: []\n");
  EXPECT_EQ(read_pipeline(file).name, "a");
  EXPECT_EQ(read_pipeline(file, {{"n", "b"}}).name, "b");
  EXPECT_THAT(message_of([&] {
                read_pipeline(file, {{"m", "b"}});
              }),
              HasSubstr("unknown variable 'm' (did you mean 'n'?)"));
}

TEST(PipelineFile, ReadsMapsAsPathsChannelsAndConstants) {
  const Workshop shop;
  const auto file = shop.write("a.yaml", R"(
version: 1
sets:
  - name: hero
    normal_zero: 127
    maps:
      albedo: a.png
      roughness: { path: orm.png, channel: g }
      specular: { value: 1.5, encoding: ior }
      specular_color: { value: [0.1, 0.2, 0.3] }
bakes: []
)");
  const SetChoice set = read_pipeline(file).sets.at(0);
  EXPECT_EQ(set.maps.at(0).slot, Slot::BaseColor);
  EXPECT_EQ(set.maps.at(0).path, shop / "a.png");
  EXPECT_EQ(set.maps.at(1).channel, "g");
  EXPECT_EQ(set.maps.at(2).encoding, SpecularEncoding::Ior);
  EXPECT_EQ(set.maps.at(2).value->at(0), 1.5f);
  EXPECT_EQ(set.maps.at(3).value->at(2), 0.3f);
  EXPECT_EQ(set.reading.normal_zero, NormalZero::Code127);
}

TEST(PipelineFile, ReadsWhatTheNumbersOfAMapAre) {
  const Workshop shop;
  const auto file = shop.write("a.yaml", R"(
version: 1
sets:
  - name: hero
    maps:
      roughness: { path: a.png, encoding: alpha, scale: 0.5 }
      base_color: { path: c.png, scale: [1, 0.5, 0.25] }
      anisotropy: { path: d.png, channel: b, encoding: gltf }
      anisotropy_angle: { path: d.png, encoding: direction, offset: 0.3 }
bakes: []
)");
  const SetChoice set = read_pipeline(file).sets.at(0);
  EXPECT_EQ(set.maps.at(0).decoding.roughness, RoughnessEncoding::Alpha);
  EXPECT_EQ(set.maps.at(0).decoding.scale[2], 0.5f);
  EXPECT_EQ(set.maps.at(1).decoding.scale[2], 0.25f);
  EXPECT_EQ(set.maps.at(2).decoding.anisotropy, AnisotropyEncoding::Gltf);
  EXPECT_EQ(set.maps.at(3).decoding.angle, AngleEncoding::Direction);
  EXPECT_EQ(set.maps.at(3).decoding.offset[0], 0.3f);
  const auto wrong = shop.write("b.yaml", R"(
version: 1
sets:
  - name: hero
    maps:
      roughness: { path: a.png, encoding: ior }
      gloss: { path: a.png, encoding: alpha }
bakes: []
)");
  const std::string all = message_of([&] { read_pipeline(wrong); });
  EXPECT_THAT(all, HasSubstr("found 'ior', expected of roughness: perceptual, alpha"));
  EXPECT_THAT(all, HasSubstr("encoding: gloss has none"));
}

TEST(PipelineFile, RefusesMapsThatMakeNoSense) {
  const Workshop shop;
  const auto file = shop.write("a.yaml", R"(
version: 1
sets:
  - name: hero
    maps:
      ruffness: a.png
      base_color: a.png
      albedo: b.png
      metallic: { path: m.png, value: 1 }
      roughness: { path: m.png, channel: rgb }
      gloss: { value: shiny }
      height: 0.5
  - { glob: "*/", name: x }
  - { name: y }
bakes: []
)");
  const std::string all = message_of([&] { read_pipeline(file); });
  EXPECT_THAT(all, HasSubstr("a.yaml:6:7: unknown map 'ruffness' (did you mean 'roughness'?)"));
  EXPECT_THAT(all, HasSubstr("a.yaml:8:7: 'albedo' fills the same slot as 'base_color'"));
  EXPECT_THAT(all, HasSubstr("metallic: expected either a path or a value"));
  EXPECT_THAT(all, HasSubstr("roughness takes one of r, g, b, a"));
  EXPECT_THAT(all, HasSubstr("found 'shiny', expected a number"));
  EXPECT_THAT(all, HasSubstr("height: found '0.5', expected a file, or { value: 0.5 }"));
  EXPECT_THAT(all, HasSubstr("a glob makes many sets"));
  EXPECT_THAT(all, HasSubstr("a set needs one of: glob, path, maps"));
}

TEST(PipelineFile, IsTheSameAsJson) {
  const Workshop shop;
  const auto file = shop.write(
      "a.json", R"({"version":1,"name":"j","bakes":[{"bake":"lut","size":"8x4","out":"a.exr"}]})");
  const Pipeline pipeline = read_pipeline(file);
  EXPECT_EQ(pipeline.name, "j");
  EXPECT_EQ(pipeline.bakes.at(0).settings.at(0).text, "8x4");
}

TEST(MaterialFile, HoldsOneSetAndItsModel) {
  const Workshop shop;
  const auto file = shop.write(
      "hero.yaml", "maps: { base_color: a.png }\nmaterial: { diffuse: lambert, energy: none }\n");
  const MaterialFile read = read_material_file(file);
  EXPECT_EQ(read.set.name, "hero");
  EXPECT_EQ(read.set.maps.size(), 1u);
  EXPECT_EQ(read.material.surface.diffuse, "lambert");
  EXPECT_EQ(read.material.surface.energy, "none");
}

TEST(BakeChoice, FromTheCommandLineIsCheckedLikeAFile) {
  const BakeChoice choice = bake_choice({{"bake", "lut"}, {"out", "a.exr"}, {"size", "16"}});
  EXPECT_EQ(choice.settings.at(0).name, "size");
  EXPECT_EQ(message_of([] {
              bake_choice({{"bake", "lut"}, {"out", "a.exr"}, {"size", "0"}});
            }).find("size: found '0'"),
            0u);
}

TEST(ColorConfigChoice, GoesFromTheCommandLineToTheFileToTheEnvironment) {
  setenv("OCIO", "/from/environment.ocio", 1);
  EXPECT_EQ(chosen_config("a.ocio", "b.ocio"), "a.ocio");
  EXPECT_EQ(chosen_config("", "b.ocio"), "b.ocio");
  EXPECT_EQ(chosen_config("", ""), "/from/environment.ocio");
  unsetenv("OCIO");
  EXPECT_EQ(chosen_config("", ""), "builtin");
}

}  // namespace
}  // namespace kiln

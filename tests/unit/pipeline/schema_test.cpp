// SPDX-License-Identifier: Apache-2.0
#include "kiln/pipeline/schema.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "kiln/brdf/models.h"
#include "support/workshop.h"

namespace kiln {
namespace {

using test::message_of;
using testing::HasSubstr;

std::string mistakes_in(const std::string& text) {
  const Node root = parse_document(text, "rocks.yaml");
  Mistakes mistakes;
  check(root, "pipeline", mistakes);
  if (mistakes.empty()) return "";
  return message_of([&] { mistakes.raise(); });
}

const Key& key_of(const std::string& block, const std::string& name) {
  for (const Key& key : block_named(block).keys) {
    if (key.facts.name == name) return key;
  }
  throw std::runtime_error("no key " + name);
}

TEST(Schema, AcceptsAWholePipeline) {
  EXPECT_EQ(mistakes_in(R"(
version: 1
name: rocks
vars: { textures: ../textures }
color: { config: builtin, working: lin_rec709_scene, on_conversion: warn }
environment: { studio: "{textures}/env/studio.exr", dusk: { path: dusk.exr, rotate: 90 } }
sets:
  - glob: "{textures}/*/"
    naming: [polyhaven, ambientcg]
  - name: hero
    maps:
      base_color: hero.png
      roughness: { path: orm.png, channel: g }
      normal: { path: n.png, convention: dx }
      specular: { value: 0.5, encoding: level }
material: { workflow: metal-rough, distribution: ggx, diffuse: eon, energy: multiscatter }
bakes:
  - { bake: lut, table: split-sum, out: lut/dfg.exr }
  - { bake: environment, env: studio, size: 256, out: env/studio }
  - { bake: preview, env: studio, shape: flat, samples: 16, out: "{set}/flat.exr" }
)"),
            "");
}

TEST(Schema, NamesTheNearestKeyAndWhereTheWrongOneStands) {
  EXPECT_EQ(
      mistakes_in("version: 1\nbakes: []\nsets:\n  - maps:\n      roughness: { pth: a.png }\n"),
      "rocks.yaml:5:20: unknown key 'pth' (did you mean 'path'?)");
}

TEST(Schema, RefusesDuplicateKeysInEitherSpelling) {
  EXPECT_EQ(
      mistakes_in("version: 1\nbakes: []\ncolor:\n  on_conversion: warn\n  on-conversion: warn\n"),
      "rocks.yaml:5:3: duplicate key 'on-conversion' (first at line 4)");
}

TEST(Schema, RefusesAnotherVersion) {
  EXPECT_THAT(mistakes_in("version: 2\nbakes: []\n"),
              HasSubstr("rocks.yaml:1:10: version: found '2'"));
  EXPECT_THAT(mistakes_in("bakes: []\n"), HasSubstr("key 'version' is missing"));
}

TEST(Schema, ReportsEveryMistakeInOnePass) {
  const std::string all = mistakes_in(
      "version: 1\nnme: x\nmaterial: { diffuse: lambrt }\nbakes:\n"
      "  - { bake: preview, env: e, out: a.exr, samples: many }\n  - { bake: previw, out: b.exr "
      "}\n");
  EXPECT_THAT(all, HasSubstr("rocks.yaml:2:1: unknown key 'nme' (did you mean 'name'?)"));
  EXPECT_THAT(all,
              HasSubstr("rocks.yaml:3:22: unknown diffuse 'lambrt' (did you mean 'lambert'?)"));
  EXPECT_THAT(all, HasSubstr("rocks.yaml:5:51: samples: found 'many'"));
  EXPECT_THAT(all, HasSubstr("rocks.yaml:6:13: unknown bake 'previw' (did you mean 'preview'?)"));
}

TEST(Schema, KnowsTheParametersOfEachBake) {
  EXPECT_THAT(mistakes_in("version: 1\nbakes:\n  - { bake: lut, out: a.exr, samples: 3 }\n"),
              HasSubstr("unknown key 'samples'"));
}

TEST(Schema, RefusesOneShapeInThePlaceOfAnother) {
  EXPECT_THAT(mistakes_in("version: 1\nbakes: nothing\n"),
              HasSubstr("bakes: found a text, expected a list"));
  EXPECT_THAT(mistakes_in("version: [1]\nbakes: []\n"), HasSubstr("version: found a list"));
  EXPECT_THAT(mistakes_in("version: 1\nbakes: []\nname:\n"), HasSubstr("name: found nothing"));
}

TEST(Schema, OffersTheModelsThatThereAre) {
  EXPECT_EQ(key_of("material", "distribution").facts.choices, model_names("distribution"));
  EXPECT_EQ(key_of("material", "masking").facts.choices, model_names("masking"));
  EXPECT_EQ(key_of("material", "fresnel").facts.choices, model_names("fresnel"));
  EXPECT_EQ(key_of("material", "diffuse").facts.choices, model_names("diffuse"));
}

TEST(Schema, IsPrintedAsJsonSchema) {
  const auto json = nlohmann::json::parse(schema_json());
  EXPECT_EQ(json["type"], "object");
  EXPECT_EQ(json["properties"]["bakes"]["items"]["$ref"], "#/$defs/bake");
  for (const BlockFacts& block : all_blocks()) {
    const bool root = block.name == "pipeline";
    EXPECT_TRUE(root || json["$defs"].contains(block.name)) << block.name;
  }
  for (const BakeFacts& bake : all_bakes()) {
    const auto& schema = json["$defs"]["bake-" + bake.name];
    EXPECT_EQ(schema["properties"]["bake"]["const"], bake.name);
    for (const ParamFacts& param : bake.params) {
      EXPECT_TRUE(schema["properties"].contains(param.name)) << param.name;
    }
  }
}

TEST(Schema, DescribesEveryKey) {
  for (const BlockFacts& block : all_blocks()) {
    for (const Key& key : block.keys) EXPECT_FALSE(key.facts.meaning.empty()) << key.facts.name;
  }
}

TEST(Variables, AreReplacedEverywhereButAmongThemselves) {
  Node root = parse_document("vars: { t: x }\nname: \"{t}/{set}/{T-}\"\n", "rocks.yaml");
  Mistakes mistakes;
  substitute(root, {{"t", "far"}, {"t_", "away"}}, mistakes);
  EXPECT_TRUE(mistakes.empty());
  EXPECT_EQ(root.find("name")->text, "far/{set}/away");
}

TEST(Variables, ThatAreUnknownNameTheNearest) {
  Node root = parse_document("name: \"{texture}/x\"\n", "rocks.yaml");
  Mistakes mistakes;
  substitute(root, {{"textures", "x"}}, mistakes);
  EXPECT_EQ(message_of([&] { mistakes.raise(); }),
            "rocks.yaml:1:7: unknown variable 'texture' (did you mean 'textures'?)");
}

}  // namespace
}  // namespace kiln

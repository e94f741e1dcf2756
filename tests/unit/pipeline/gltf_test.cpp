// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "kiln/pipeline/run.h"
#include "support/planned_sets.h"

namespace kiln {
namespace {

using test::input_fault_of;
using test::map_of;
using test::sets_of_document;
using test::text_of;
using test::Workshop;
using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::vector<PlannedSet> sets_of(const Workshop& shop, const std::string& json) {
  return sets_of_document(shop.write("a.gltf", R"({"asset": {"version": "2.0"}, )" + json + "}"));
}

std::string fault_of_json(const Workshop& shop, const std::string& json) {
  return input_fault_of(sets_of(shop, json));
}

bool has(const PlannedSet& set, Slot slot) {
  return std::any_of(set.maps.begin(), set.maps.end(),
                     [&](const PlannedMap& map) { return map.slot == slot; });
}

const char* const three_images = R"(
"images": [{"uri": "a%20b.png"}, {"uri": "mr.png"}, {"uri": "n.png"}],
"samplers": [{"wrapS": 33071, "wrapT": 33071}],
"textures": [{"source": 0, "sampler": 0}, {"source": 1, "sampler": 0}, {"source": 2, "sampler": 0}],
)";

TEST(Gltf, FillsTheSlotsOfMetallicRoughness) {
  const Workshop shop;
  const auto sets = sets_of(shop, std::string(three_images) + R"("materials": [{
    "name": "brick",
    "pbrMetallicRoughness": {
      "baseColorTexture": {"index": 0}, "baseColorFactor": [0.5, 0.6, 0.7, 0.8],
      "metallicRoughnessTexture": {"index": 1}, "roughnessFactor": 0.25},
    "normalTexture": {"index": 2, "scale": 0.5},
    "occlusionTexture": {"index": 1, "strength": 0.75},
    "alphaMode": "MASK", "alphaCutoff": 0.3}])");
  ASSERT_EQ(sets.size(), 1u);
  const PlannedSet& set = sets[0];
  EXPECT_FALSE(set.fault);
  EXPECT_EQ(set.name, "brick");
  EXPECT_EQ(set.reading.workflow, Workflow::MetalRough);
  EXPECT_EQ(set.reading.wrap, WrapChoice::Clamp);
  EXPECT_EQ(map_of(set, Slot::BaseColor).path, shop / "a b.png");
  EXPECT_EQ(map_of(set, Slot::BaseColor).color_space, "srgb_rec709_scene");
  EXPECT_THAT(map_of(set, Slot::BaseColor).decoding.scale, ElementsAre(0.5f, 0.6f, 0.7f));
  EXPECT_EQ(map_of(set, Slot::Roughness).channels, "g");
  EXPECT_EQ(map_of(set, Slot::Roughness).decoding.scale[0], 0.25f);
  EXPECT_EQ(map_of(set, Slot::Metallic).channels, "b");
  EXPECT_EQ(map_of(set, Slot::Metallic).decoding.scale[0], 1.0f);
  EXPECT_EQ(map_of(set, Slot::Normal).convention, NormalConvention::OpenGl);
  EXPECT_EQ(map_of(set, Slot::Normal).decoding.scale[0], 0.5f);
  EXPECT_EQ(map_of(set, Slot::AmbientOcclusion).decoding.scale[0], 0.75f);
  EXPECT_EQ(map_of(set, Slot::AmbientOcclusion).decoding.offset[0], 0.25f);
  EXPECT_EQ(map_of(set, Slot::Opacity).channels, "a");
  EXPECT_EQ(set.alpha_cutoff, 0.3);
}

TEST(Gltf, WithoutTexturesIsConstantsAndItsDefaultsAreWhiteRoughMetal) {
  const Workshop shop;
  const auto sets = sets_of(shop, R"("materials": [{"pbrMetallicRoughness": {}}])");
  const PlannedSet& set = sets.at(0);
  EXPECT_EQ(set.name, "a") << "after the file";
  EXPECT_THAT(*map_of(set, Slot::BaseColor).value, ElementsAre(1, 1, 1));
  EXPECT_EQ(map_of(set, Slot::BaseColor).color_space, "lin_rec709_scene");
  EXPECT_EQ(map_of(set, Slot::Metallic).value->at(0), 1);
  EXPECT_EQ(map_of(set, Slot::Roughness).value->at(0), 1);
  EXPECT_EQ(map_of(set, Slot::SpecularLevel).encoding, SpecularEncoding::Ior);
  EXPECT_EQ(map_of(set, Slot::SpecularLevel).value->at(0), 1.5f);
  EXPECT_FALSE(has(set, Slot::Opacity));
  EXPECT_FALSE(has(set, Slot::Emissive));
}

TEST(Gltf, ReadsSpecularIorAnisotropyAndSpecularGlossiness) {
  const Workshop shop;
  const auto sets = sets_of(shop, std::string(three_images) + R"("materials": [
  {"name": "coat", "extensions": {
    "KHR_materials_ior": {"ior": 1.33},
    "KHR_materials_specular": {"specularFactor": 0.5, "specularTexture": {"index": 0},
                               "specularColorFactor": [2, 1, 0.5]},
    "KHR_materials_anisotropy": {"anisotropyStrength": 0.6, "anisotropyRotation": 0.5,
                                 "anisotropyTexture": {"index": 1}},
    "KHR_materials_clearcoat": {"clearcoatFactor": 1}}},
  {"name": "old", "extensions": {"KHR_materials_pbrSpecularGlossiness": {
    "diffuseFactor": [0.1, 0.2, 0.3, 1], "specularGlossinessTexture": {"index": 0},
    "glossinessFactor": 0.7}}}])");
  ASSERT_EQ(sets.size(), 2u);
  EXPECT_EQ(map_of(sets[0], Slot::SpecularLevel).value->at(0), 1.33f);
  EXPECT_EQ(map_of(sets[0], Slot::SpecularWeight).channels, "a");
  EXPECT_EQ(map_of(sets[0], Slot::SpecularWeight).decoding.scale[0], 0.5f);
  EXPECT_THAT(*map_of(sets[0], Slot::SpecularTint).value, ElementsAre(2, 1, 0.5f));
  EXPECT_EQ(map_of(sets[0], Slot::Anisotropy).channels, "b");
  EXPECT_EQ(map_of(sets[0], Slot::Anisotropy).decoding.anisotropy, AnisotropyEncoding::Gltf);
  EXPECT_EQ(map_of(sets[0], Slot::AnisotropyAngle).channels, "rg");
  EXPECT_EQ(map_of(sets[0], Slot::AnisotropyAngle).decoding.offset[0], 0.5f);
  ASSERT_EQ(sets[0].ignored.size(), 1u);
  EXPECT_EQ(sets[0].ignored[0].file, "KHR_materials_clearcoat");
  EXPECT_EQ(sets[1].reading.workflow, Workflow::SpecGloss);
  EXPECT_THAT(*map_of(sets[1], Slot::Diffuse).value, ElementsAre(0.1f, 0.2f, 0.3f));
  EXPECT_EQ(map_of(sets[1], Slot::Gloss).channels, "a");
  EXPECT_EQ(map_of(sets[1], Slot::Gloss).decoding.scale[0], 0.7f);
}

std::string two_textures(const std::string& base, const std::string& normal) {
  const auto use = [](const std::string& index, const std::string& transform) {
    if (transform.empty()) return "{\"index\": " + index + "}";
    return "{\"index\": " + index + ", \"extensions\": {\"KHR_texture_transform\": " + transform +
           "}}";
  };
  return R"("images": [{"uri": "c.png"}, {"uri": "n.png"}],
    "textures": [{"source": 0}, {"source": 1}], "materials": [{
    "pbrMetallicRoughness": {"baseColorTexture": )" +
         use("0", base) + R"(}, "normalTexture": )" + use("1", normal) + "}]";
}

TEST(Gltf, TakesATransformThatAllTexturesShareForThatOfTheMesh) {
  const Workshop shop;
  const std::string tiled = R"({"offset": [0.25, 0], "scale": [2, 2]})";
  const PlannedSet set = sets_of(shop, two_textures(tiled, tiled)).at(0);
  EXPECT_THAT(set.warnings, IsEmpty());
  ASSERT_EQ(set.ignored.size(), 1u);
  EXPECT_EQ(set.ignored[0].file, "KHR_texture_transform");
  EXPECT_THAT(set.ignored[0].reason, HasSubstr("offset 0.25 0, scale 2 2 of all its textures"));
}

TEST(Gltf, SeesThatATransformMovesNothing) {
  const Workshop shop;
  const PlannedSet set =
      sets_of(shop, two_textures(R"({"offset": [3, -1], "scale": [1, 1]})", "")).at(0);
  EXPECT_THAT(set.warnings, IsEmpty());
  EXPECT_THAT(set.ignored, IsEmpty());
}

TEST(Gltf, SaysWhichTexturesLieDifferentlyOnTheMesh) {
  const Workshop shop;
  const PlannedSet moved =
      sets_of(shop, two_textures(R"({"scale": [4, 4], "rotation": 0.5})", "")).at(0);
  EXPECT_THAT(moved.warnings, ElementsAre(HasSubstr(
                                  "(baseColorTexture rotation 0.5, scale 4 4; normalTexture as it "
                                  "is), but are read texel by texel")));
  const PlannedSet second = sets_of(shop, two_textures(R"({"texCoord": 1})", "")).at(0);
  EXPECT_THAT(second.warnings, ElementsAre(HasSubstr("baseColorTexture as it is on coordinates 1; "
                                                     "normalTexture as it is on coordinates 0")));
}

TEST(Gltf, ChoosesAMaterialByName) {
  const Workshop shop;
  const auto file = shop.write("two.gltf",
                               R"({"asset": {"version": "2.0"},
                               "materials": [{"name": "a"}, {"name": "b/c"}, {"name": "a"}]})");
  const auto all = sets_of_document(file);
  ASSERT_EQ(all.size(), 3u);
  EXPECT_EQ(all[1].name, "b_c");
  EXPECT_EQ(all[2].name, "a_2");
  EXPECT_EQ(sets_of_document(file, ", material: a_2, name: hero").at(0).name, "hero");
  EXPECT_EQ(sets_of_document(file, ", name: hero").at(1).name, "hero.b_c");
  EXPECT_THAT(test::message_of([&] { sets_of_document(file, ", material: a_3"); }),
              HasSubstr("did you mean 'a_2'?"));
}

std::string base64(const std::string& bytes) {
  const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (size_t i = 0; i < bytes.size(); i += 3) {
    uint32_t bits = 0;
    for (size_t k = 0; k < 3; ++k) {
      bits = bits << 8 | (i + k < bytes.size() ? static_cast<uint8_t>(bytes[i + k]) : 0u);
    }
    for (size_t k = 0; k < 4; ++k) {
      text += i + k > bytes.size() ? '=' : digits[bits >> (18 - 6 * k) & 63];
    }
  }
  return text;
}

std::string little_endian(size_t number) {
  std::string bytes;
  for (int i = 0; i < 4; ++i) bytes += static_cast<char>(number >> (8 * i) & 255);
  return bytes;
}

std::string glb(std::string json, std::string binary) {
  while (json.size() % 4) json += ' ';
  while (binary.size() % 4) binary += '\0';
  const std::string chunks = little_endian(json.size()) + "JSON" + json +
                             little_endian(binary.size()) + std::string("BIN\0", 4) + binary;
  return "glTF" + little_endian(2) + little_endian(12 + chunks.size()) + chunks;
}

// The colour that a base colour image of this file comes to, seen as a metal in a white room.
float shown(const Workshop& shop, const std::string& file) {
  shop.paint("sky.exr", 1.0f, PixelType::Float, {16, 8});
  const auto pipeline = shop.write("p.yaml",
                                   "version: 1\nenvironment: { sky: sky.exr }\n"
                                   "sets: [{ path: " +
                                       file +
                                       ", name: s }]\nmaterial: { energy: none }\n"
                                       "bakes: [{ bake: preview, env: sky, samples: 64, size: 1, "
                                       "type: float, out: s.exr }]\n");
  const Report report = run_plan(make_plan(read_pipeline(pipeline), shop / "out"), Records::None);
  if (report.tasks.at(0).fault) {
    ADD_FAILURE() << report.tasks[0].fault->what();
    return 0;
  }
  return read_image(shop / "out/s.exr").image.find("R")->at(0, 0);
}

TEST(Gltf, HoldsImagesBesideItselfInItsTextAndInItsBinaryChunk) {
  const Workshop shop;
  shop.paint("c.png", 188 / 255.0f, PixelType::Uint8);
  const std::string png = text_of(shop / "c.png");
  const std::string rest = R"("textures": [{"source": 0}], "materials": [{
    "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}, "roughnessFactor": 0.1,
                             "baseColorFactor": [0.5, 0.5, 0.5, 1]}}])";
  const std::string asset = R"({"asset": {"version": "2.0"}, )";
  shop.write("file.gltf", asset + R"("images": [{"uri": "c.png"}], )" + rest + "}");
  shop.write("text.gltf", asset + R"("images": [{"uri": "data:image/png;base64,)" + base64(png) +
                              "\"}], " + rest + "}");
  const std::string view = R"("images": [{"bufferView": 0, "mimeType": "image/png"}],
    "bufferViews": [{"buffer": 0, "byteOffset": 4, "byteLength": )" +
                           std::to_string(png.size()) + "}], ";
  shop.write("packed.glb", glb(asset + view + R"("buffers": [{"byteLength": )" +
                                   std::to_string(png.size() + 4) + "}], " + rest + "}",
                               "1234" + png));
  shop.write("b.bin", "1234" + png);
  shop.write("apart.gltf",
             asset + view + R"("buffers": [{"uri": "b.bin", "byteLength": 1}], )" + rest + "}");
  const float from_file = shown(shop, "file.gltf");
  EXPECT_NEAR(from_file, 0.25f, 0.03f);
  EXPECT_EQ(shown(shop, "text.gltf"), from_file);
  EXPECT_EQ(shown(shop, "packed.glb"), from_file);
  EXPECT_EQ(shown(shop, "apart.gltf"), from_file);
}

TEST(Gltf, ThatIsBrokenSaysWhere) {
  const Workshop shop;
  const auto broken = sets_of_document(shop.write("x.gltf", "{\n  \"asset\": {,\n}"));
  ASSERT_TRUE(broken.at(0).fault);
  EXPECT_EQ(broken[0].fault->fault(), Fault::Input);
  EXPECT_THAT(broken[0].fault->what(), HasSubstr("x.gltf:2:13: this is not JSON"));
  EXPECT_THAT(sets_of_document(shop.write("x.gltf", "{"))[0].fault->what(),
              HasSubstr("ends too early"));
  EXPECT_THAT(sets_of_document(shop / "none.gltf")[0].fault->what(), HasSubstr("no such file"));
  EXPECT_THAT(
      sets_of_document(shop.write("x.gltf", R"({"asset": {"version": "1.0"}})"))[0].fault->what(),
      HasSubstr("version is '1.0', expected 2.0"));
  EXPECT_THAT(fault_of_json(shop, R"("materials": [])"), HasSubstr("no material"));
  EXPECT_THAT(fault_of_json(shop, R"("extensionsRequired": ["KHR_new"], "materials": [{}])"),
              AllOf(HasSubstr("extensionsRequired"), HasSubstr("'KHR_new' is required")));
  EXPECT_THAT(
      fault_of_json(shop,
                    R"("materials": [{}, {"pbrMetallicRoughness": {"metallicFactor": "much"}}])"),
      HasSubstr("materials[1].pbrMetallicRoughness.metallicFactor: found a text, expected a num"));
  EXPECT_THAT(fault_of_json(shop, R"("materials": [{"normalTexture": {"index": 3}}])"),
              HasSubstr("materials[0].normalTexture: index is 3, there are 0 textures"));
  const std::string textured = R"("textures": [{"source": 0}],
    "materials": [{"normalTexture": {"index": 0}}], "images": [{"uri": ")";
  EXPECT_THAT(fault_of_json(shop, textured + R"(https://example.org/n.png"}])"),
              HasSubstr("would have to be fetched"));
  EXPECT_THAT(fault_of_json(shop, textured + R"(a%2.png"}])"), HasSubstr("broken escape"));
  EXPECT_THAT(fault_of_json(shop, textured + R"(data:image/png;base64,!!"}])"),
              HasSubstr("not base64"));
}

TEST(Gltf, InABrokenContainerSaysSo) {
  const Workshop shop;
  const std::string whole =
      glb(R"({"asset": {"version": "2.0"}, "materials": [{"name": "m"}]})", "abcd");
  EXPECT_EQ(sets_of_document(shop.write("w.glb", whole)).at(0).name, "m");
  for (size_t size = 12; size < whole.size() - 12; size += 9) {
    const auto sets = sets_of_document(shop.write("c.glb", whole.substr(0, size)));
    ASSERT_EQ(sets.size(), 1u);
    ASSERT_TRUE(sets[0].fault) << size;
    EXPECT_EQ(sets[0].fault->fault(), Fault::Input);
  }
}

}  // namespace
}  // namespace kiln

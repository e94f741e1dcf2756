// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "kiln/image/layers.h"
#include "support/command.h"
#include "support/places.h"

namespace kiln {
namespace {

using test::kiln;
using test::Outcome;
using test::Workshop;
using testing::HasSubstr;
using testing::MatchesRegex;

TEST(LutVerb, PrintsOneValueWithSeventeenDigits) {
  const Workshop shop;
  const Outcome outcome = kiln(shop, {"lut", "split-sum", "--at", "0.3,0.5"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.out, MatchesRegex("0\\.[0-9]{16,20} 0\\.[0-9]{16,20}\n"));
}

TEST(LutVerb, PrintsOneValueAsJson) {
  const Workshop shop;
  const Outcome outcome = kiln(shop, {"lut", "directional-albedo", "--at", "0.3,0.5", "--json"});
  const auto json = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(json["mu"], 0.3);
  EXPECT_EQ(json["table"], "directional-albedo");
}

TEST(LutVerb, RefusesAPointOutsideTheDomain) {
  const Workshop shop;
  EXPECT_EQ(kiln(shop, {"lut", "split-sum", "--at", "2,0.5"}).code, 2);
  EXPECT_EQ(kiln(shop, {"lut", "split-sum", "--at", "0.5"}).code, 2);
}

TEST(LutVerb, MakesAFileAndTellsItsErrors) {
  const Workshop shop;
  const std::string file = (shop / "new/dfg.exr").string();
  const Outcome outcome = kiln(shop, {"lut", "split-sum", "--size", "8x4", "-o", file});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr(file));
  EXPECT_THAT(outcome.out, HasSubstr("entry error"));
  const FileFacts facts = inspect_image(file);
  EXPECT_EQ(facts.size, (Size{8, 4}));
  EXPECT_EQ(facts.type, PixelType::Float);
  EXPECT_FALSE(std::filesystem::exists(shop / "new/.kiln"));
}

TEST(LutVerb, EndsWithTheFaultOfItsOnlyTask) {
  const Workshop shop;
  shop.write("file", "x");
  EXPECT_EQ(kiln(shop, {"lut", "split-sum", "-o", (shop / "file/a.exr").string()}).code, 5);
  EXPECT_EQ(kiln(shop, {"lut", "split-sum", "-o", (shop / "a.xyz").string()}).code, 2);
}

TEST(EnvVerb, WritesTheChainAndItsDescription) {
  const Workshop shop;
  const auto sky = shop.paint("sky.exr", 1.0f, PixelType::Float, {32, 16});
  const std::string out = (shop / "out").string();
  const Outcome outcome = kiln(shop, {"env", sky.string(), "-o", out, "--size", "16"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  for (const char* name : {"specular_m0_px.exr", "irradiance_ny.exr", "sh.json", "env.json"}) {
    EXPECT_TRUE(std::filesystem::exists(shop / "out" / name)) << name;
  }
  EXPECT_TRUE(nlohmann::json::accept(test::text_of(shop / "out/env.json")));
}

TEST(EnvVerb, TellsHowTheImageWasRead) {
  const Workshop shop;
  const auto cross = shop.paint("cross.exr", 1.0f, PixelType::Float, {32, 24});
  const std::string out = (shop / "out").string();
  std::vector<std::string> words = {"env", cross.string(), "-o", out, "--size", "16"};
  const Outcome found = kiln(shop, words);
  EXPECT_EQ(found.code, 0) << found.err;
  EXPECT_THAT(found.err,
              HasSubstr("projection cube-cross: six faces px nx py ny pz nz of 8 x 8 (4:3)"));
  EXPECT_THAT(found.err, HasSubstr("mirror none, up y, rotate 0"));
  words.insert(words.end(), {"--mirror", "x", "--up", "z", "--projection", "cube-cross"});
  const Outcome stated = kiln(shop, words);
  EXPECT_EQ(stated.code, 0) << stated.err;
  EXPECT_THAT(stated.err, HasSubstr("(4:3, as stated)"));
  EXPECT_THAT(stated.err, HasSubstr("mirror x, up z, rotate 0"));
}

TEST(EnvVerb, ReadsSixFilesAndSaysWhichIsMissing) {
  const Workshop shop;
  for (const char* face : {"px", "nx", "py", "ny", "pz"}) {
    shop.paint(std::string("sky_") + face + ".exr", 1.0f, PixelType::Float, {8, 8});
  }
  const std::string out = (shop / "out").string();
  const std::vector<std::string> words = {
      "env", (shop / "sky_<FACE>.exr").string(), "-o", out, "--size", "16"};
  const Outcome missing = kiln(shop, words);
  EXPECT_EQ(missing.code, 3);
  EXPECT_THAT(missing.err, HasSubstr("missing: nz"));
  EXPECT_FALSE(std::filesystem::exists(shop / "out/env.json"));
  shop.paint("sky_nz.exr", 1.0f, PixelType::Float, {8, 8});
  EXPECT_EQ(kiln(shop, words).code, 0);
}

TEST(EnvVerb, RefusesASquareUnlessItIsSaidToBeOctahedral) {
  const Workshop shop;
  const auto square = shop.paint("square.exr", 1.0f, PixelType::Float, {16, 16});
  std::vector<std::string> words = {"env", square.string(), "-o", (shop / "out").string(), "--size",
                                    "16"};
  const Outcome refused = kiln(shop, words);
  EXPECT_EQ(refused.code, 3);
  EXPECT_THAT(refused.err, HasSubstr("State the projection: octahedral"));
  words.insert(words.end(), {"--projection", "octahedral"});
  EXPECT_EQ(kiln(shop, words).code, 0);
  words.back() = "sphere";
  const Outcome unknown = kiln(shop, words);
  EXPECT_EQ(unknown.code, 2);
  EXPECT_THAT(unknown.err, HasSubstr("projection"));
}

TEST(EnvVerb, OfAMissingImageIsAnInputError) {
  const Workshop shop;
  const Outcome outcome =
      kiln(shop, {"env", (shop / "no.exr").string(), "-o", (shop / "o").string()});
  EXPECT_EQ(outcome.code, 3);
  EXPECT_THAT(outcome.err, HasSubstr("no.exr"));
}

TEST(PreviewVerb, TellsWhichFileTookWhichSlotAndWhy) {
  const Workshop shop;
  const auto sky = shop.paint("sky.exr", 1.0f, PixelType::Float, {16, 8});
  shop.paint_set("rock");
  const Outcome outcome = kiln(shop, {"preview", (shop / "rock").string(), "--env", sky.string(),
                                      "--samples", "4", "-o", (shop / "a.png").string()});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("rock_Roughness.png"));
  EXPECT_THAT(outcome.err, HasSubstr("srgb_rec709_scene -> lin_rec709_scene"));
  EXPECT_EQ(inspect_image(shop / "a.png").size, (Size{4, 4}));
}

TEST(PreviewVerb, IsLitByAnyProjection) {
  const Workshop shop;
  const auto strip = shop.paint("strip.exr", 1.0f, PixelType::Float, {48, 8});
  shop.paint_set("rock");
  const Outcome outcome =
      kiln(shop, {"preview", (shop / "rock").string(), "--env", strip.string(), "--projection",
                  "cube-strip", "--samples", "4", "-o", (shop / "a.png").string()});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("(6:1, as stated)"));
}

TEST(PreviewVerb, IsLitByLightsAloneOrBesideAnEnvironment) {
  const Workshop shop;
  const auto sky = shop.paint("sky.exr", 1.0f, PixelType::Float, {16, 8});
  shop.paint_set("rock");
  const std::vector<std::string> words = {"preview",
                                          "--light",
                                          "dir:0,1,1:1,1,1",
                                          "--light",
                                          "dir:1,0,1:2,1,1",
                                          (shop / "rock").string(),
                                          "-o",
                                          (shop / "a.exr").string(),
                                          "--samples",
                                          "4"};
  const Outcome alone = kiln(shop, words);
  EXPECT_EQ(alone.code, 0) << alone.err;
  const double dark = read_image(shop / "a.exr").image.find("R")->at(1, 1);
  std::vector<std::string> beside = words;
  beside.insert(beside.end(), {"--env", sky.string()});
  const Outcome both = kiln(shop, beside);
  EXPECT_EQ(both.code, 0) << both.err;
  EXPECT_GT(dark, 0.1);
  EXPECT_GT(read_image(shop / "a.exr").image.find("R")->at(1, 1), dark + 0.1);
}

TEST(PreviewVerb, ShowsDifferencesInFalseColoursAndWritesTheirNumbers) {
  const Workshop shop;
  const auto studio = test::source_folder() / "textures/env/studio.exr";
  shop.paint_set("rock");
  const auto made = [&](const char* name) {
    return kiln(shop, {"preview", (shop / "rock").string(), "--env", studio.string(), "--samples",
                       "16", "--size", "64", "--mode", "difference", "-o", (shop / name).string()});
  };
  EXPECT_EQ(made("a.png").code, 0);
  EXPECT_GT(inspect_image(shop / "a.png").size.height, 64);
  EXPECT_EQ(made("a.exr").code, 0);
  EXPECT_GT(count_oddities(read_image(shop / "a.exr").image).negative, 0);
  const Outcome refused = made("a.hdr");
  EXPECT_EQ(refused.code, 2);
  EXPECT_THAT(refused.err, HasSubstr("hdr holds no negative numbers"));
  EXPECT_FALSE(std::filesystem::exists(shop / "a.hdr"));
}

TEST(PreviewVerb, ReadsAMaterialFile) {
  const Workshop shop;
  const auto sky = shop.paint("sky.exr", 1.0f, PixelType::Float, {16, 8});
  shop.paint("c.exr", 0.5f, PixelType::Half);
  const auto file = shop.write("m.yaml",
                               "maps: { base_color: c.exr, roughness: { value: 0.4 } }\n"
                               "material: { diffuse: lambert }\n");
  const Outcome outcome = kiln(shop, {"preview", file.string(), "--env", sky.string(), "--samples",
                                      "4", "-o", (shop / "a.exr").string(), "-q"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
}

TEST(PreviewVerb, ListsTheSetsOfAFolderThatHoldsTwo) {
  const Workshop shop;
  const auto sky = shop.paint("sky.exr", 1.0f, PixelType::Float, {16, 8});
  for (const char* map :
       {"BaseColor", "Roughness", "Metallic", "Diffuse", "Specular", "Glossiness"}) {
    shop.paint(std::string("two/two_") + map + ".exr", 0.5f, PixelType::Half);
  }
  std::vector<std::string> words = {
      "preview", (shop / "two").string(),  "--env", sky.string(), "--samples", "4",
      "-o",      (shop / "a.exr").string()};
  const Outcome refused = kiln(shop, words);
  EXPECT_EQ(refused.code, 2);
  EXPECT_THAT(refused.err, HasSubstr("two.metal_rough"));
  EXPECT_THAT(refused.err, HasSubstr("two.spec_gloss"));
  words.insert(words.end(), {"--name", "two.spec_gloss"});
  const Outcome chosen = kiln(shop, words);
  EXPECT_EQ(chosen.code, 0) << chosen.err;
  EXPECT_THAT(chosen.err, HasSubstr("two_Glossiness.exr"));
}

TEST(PreviewVerb, OfAFolderWithoutKnownMapIsAnInputError) {
  const Workshop shop;
  const auto sky = shop.paint("sky.exr", 1.0f, PixelType::Float, {16, 8});
  shop.write("none/readme.txt", "x");
  EXPECT_EQ(kiln(shop, {"preview", (shop / "none").string(), "--env", sky.string(), "-o",
                        (shop / "a.exr").string()})
                .code,
            3);
}

TEST(InspectVerb, TellsSizeTypeAndMean) {
  const Workshop shop;
  const auto image = shop.paint("a.exr", 0.25f, PixelType::Half);
  const auto json = nlohmann::json::parse(kiln(shop, {"inspect", image.string(), "--json"}).out);
  EXPECT_EQ(json[0]["type"], "half");
  EXPECT_EQ(json[0]["channels"][0]["mean"], 0.25);
}

TEST(InspectVerb, TellsTheSlotsOfASet) {
  const Workshop shop;
  shop.paint_set("rock", ".exr");
  const Outcome outcome = kiln(shop, {"inspect", (shop / "rock").string()});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("roughness[r]"));
  EXPECT_THAT(outcome.out, HasSubstr("read as lin_rec709_scene"));
}

TEST(InspectVerb, ShowsTheConstantsAndFactorsOfADocument) {
  const Workshop shop;
  shop.paint("c.png", 0.5f, PixelType::Uint8);
  const auto file = shop.write("a.gltf", R"({"asset": {"version": "2.0"},
    "images": [{"uri": "c.png"}], "textures": [{"source": 0}],
    "materials": [{"name": "wall", "pbrMetallicRoughness": {"baseColorTexture": {"index": 0},
      "baseColorFactor": [0.5, 0.5, 0.5, 1], "metallicFactor": 0.25}}]})");
  const Outcome outcome = kiln(shop, {"inspect", file.string()});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("set wall: metal-rough"));
  EXPECT_THAT(outcome.out, HasSubstr("metallic: constant 0.25"));
  EXPECT_THAT(outcome.out, HasSubstr("baseColorTexture, times 0.5; read as srgb_rec709_scene"));
}

TEST(PreviewVerb, OfABrokenDocumentOrMapsOfOtherAspectsIsAnInputError) {
  const Workshop shop;
  const auto sky = shop.paint("sky.exr", 1.0f, PixelType::Float, {16, 8});
  const auto broken = shop.write("a.gltf", "{\"asset\": ");
  const Outcome document = kiln(
      shop, {"preview", broken.string(), "--env", sky.string(), "-o", (shop / "a.exr").string()});
  EXPECT_EQ(document.code, 3);
  EXPECT_THAT(document.err, HasSubstr("a.gltf:1:"));
  shop.paint("odd/a_BaseColor.png", 0.5f, PixelType::Uint8, {8, 8});
  shop.paint("odd/a_Roughness.png", 0.5f, PixelType::Uint8, {8, 4});
  const Outcome odd = kiln(shop, {"preview", (shop / "odd").string(), "--env", sky.string(), "-o",
                                  (shop / "a.exr").string()});
  EXPECT_EQ(odd.code, 3);
  EXPECT_THAT(odd.err, HasSubstr("base_color a_BaseColor.png (8x8) and roughness a_Roughness.png "
                                 "(8x4) cannot belong together"));
}

TEST(InspectVerb, OfAMissingFileIsAnInputErrorThatCostsNoOther) {
  const Workshop shop;
  shop.paint_set("rock");
  shop.write("rock/rock_Normal.png", "no image");
  const std::string image = shop.paint("a.png", 0.5f, PixelType::Uint8).string();
  const Outcome outcome =
      kiln(shop, {"inspect", (shop / "no.png").string(), (shop / "rock").string(), image});
  EXPECT_EQ(outcome.code, 3);
  EXPECT_THAT(outcome.err, HasSubstr("no.png"));
  EXPECT_THAT(outcome.err, HasSubstr("rock_Normal.png"));
  EXPECT_THAT(outcome.out, HasSubstr("rock_Roughness.png"));
  EXPECT_THAT(outcome.out, HasSubstr(image));
}

TEST(BakeVerb, MakesEverySetThatTheOutputNames) {
  const Workshop shop;
  shop.paint("t.1001.png", 0.5f, PixelType::Uint8);
  shop.paint("t.1002.png", 0.5f, PixelType::Uint8);
  const std::string tiles =
      shop.write("tiles.yaml", "maps: { base_color: \"t.<UDIM>.png\" }\n").string();
  const std::string out = (shop / "out/{udim}/{suffix}.exr").string();
  const Outcome all = kiln(shop, {"bake", "derive", tiles, "--quantities", "f0", "-o", out});
  EXPECT_EQ(all.code, 0) << all.err;
  EXPECT_THAT(all.out, HasSubstr("out/1002/f0.exr"));
  EXPECT_TRUE(std::filesystem::exists(shop / "out/1001/f0.exr"));
  const Outcome one = kiln(shop, {"bake", "derive", tiles, "-o", (shop / "out").string()});
  EXPECT_EQ(one.code, 2);
  EXPECT_THAT(one.err, HasSubstr("or bake all with '{set}' in -o"));
}

TEST(BakeVerb, OfSeveralSetsTellsWhichFailed) {
  const Workshop shop;
  shop.paint("t.1001.png", 0.5f, PixelType::Uint8);
  shop.write("t.1002.png", "no image");
  const std::string tiles =
      shop.write("tiles.yaml", "maps: { base_color: \"t.<UDIM>.png\" }\n").string();
  const std::string out = (shop / "{set}_{suffix}.exr").string();
  const Outcome all = kiln(shop, {"bake", "derive", tiles, "--quantities", "f0", "-o", out});
  EXPECT_EQ(all.code, 1);
  EXPECT_THAT(all.err, HasSubstr("t.1002.png"));
  EXPECT_THAT(all.out, HasSubstr("tiles.1001_f0.exr"));
  EXPECT_TRUE(std::filesystem::exists(shop / "tiles.1001_f0.exr"));
}

TEST(DiffVerb, EndsWithSevenWhenImagesDifferByMoreThanAllowed) {
  const Workshop shop;
  const std::string a = shop.paint("a.exr", 0.5f, PixelType::Float).string();
  const std::string b = shop.paint("b.exr", 0.75f, PixelType::Float).string();
  EXPECT_EQ(kiln(shop, {"diff", a, a}).code, 0);
  EXPECT_EQ(kiln(shop, {"diff", a, b}).code, 7);
  EXPECT_EQ(kiln(shop, {"diff", a, b, "--max-error", "0.25"}).code, 0);
  EXPECT_EQ(kiln(shop, {"diff", a, b, "--rms", "0.2"}).code, 7);
  EXPECT_EQ(kiln(shop, {"diff", a, (shop / "no.exr").string()}).code, 3);
}

TEST(DiffVerb, ComparesFoldersFileByFile) {
  const Workshop shop;
  shop.paint("a/x.exr", 0.5f, PixelType::Float);
  shop.paint("b/x.exr", 0.5f, PixelType::Float);
  const std::string a = (shop / "a").string(), b = (shop / "b").string();
  EXPECT_EQ(kiln(shop, {"diff", a, b}).code, 0);
  shop.paint("b/y.exr", 0.5f, PixelType::Float);
  const Outcome outcome = kiln(shop, {"diff", a, b});
  EXPECT_EQ(outcome.code, 7);
  EXPECT_THAT(outcome.out, HasSubstr("only in"));
}

TEST(ListVerb, PrintsEveryKind) {
  const Workshop shop;
  for (const char* kind : {"models", "tables", "bakes", "namings", "maps", "colour-spaces",
                           "color-spaces", "schema"}) {
    const Outcome outcome = kiln(shop, {"list", kind});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_FALSE(outcome.out.empty()) << kind;
    EXPECT_TRUE(nlohmann::json::accept(kiln(shop, {"list", kind, "--json"}).out)) << kind;
  }
}

TEST(ListVerb, PrintsTheParametersOfABakeAndTheSourceOfAModel) {
  const Workshop shop;
  EXPECT_THAT(kiln(shop, {"list", "preview"}).out, HasSubstr("samples"));
  EXPECT_THAT(kiln(shop, {"list", "ggx"}).out, HasSubstr("source: "));
}

}  // namespace
}  // namespace kiln

// SPDX-License-Identifier: Apache-2.0
// `kiln lut` in layouts and formats, and `kiln verify` on what it made.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "support/command.h"

namespace kiln {
namespace {

using test::kiln;
using test::Outcome;
using test::Workshop;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

TEST(LutVerb, MakesEveryFormatAndSaysWhatItHoldsBesideThoseWithoutRoom) {
  const Workshop shop;
  for (const char* name :
       {"a.exr", "a.hdr", "a.png", "a.tif", "a.dds", "a.ktx2", "a.npy", "a.csv", "a.h"}) {
    const std::string file = (shop / name).string();
    const Outcome outcome = kiln(shop, {"lut", "split-sum", "--size", "6x5", "-o", file});
    EXPECT_EQ(outcome.code, 0) << name << outcome.err;
    const bool beside = std::filesystem::exists(file + ".json");
    const std::string_view format(name + 2);
    EXPECT_EQ(beside, format == "dds" || format == "npy") << name;
  }
  const auto json = nlohmann::json::parse(test::text_of(shop / "a.dds.json"));
  EXPECT_EQ(json["kiln:table"], "split-sum");
  EXPECT_TRUE(json.contains("kiln:entry_error"));
}

TEST(LutVerb, WritesTheCoordinatesOfEveryEntryIntoCsv) {
  const Workshop shop;
  const std::string file = (shop / "a.csv").string();
  EXPECT_EQ(kiln(shop, {"lut", "split-sum", "--size", "2", "-o", file}).code, 0);
  EXPECT_THAT(test::text_of(file), AllOf(HasSubstr("mu,roughness,scale,bias\n"),
                                         HasSubstr("\n0.25,0.25,"), HasSubstr("\n0.75,0.75,")));
}

TEST(LutVerb, WritesLargeVolumesAFewSlicesAtATimeForAnyNumberOfThreads) {
  const Workshop shop;
  std::vector<Layers> images;
  for (const char* name : {"a.exr", "b.exr", "a.tif", "a.dds", "a.ktx2", "a.npy"}) {
    const std::string file = (shop / name).string();
    const Outcome outcome = kiln(
        shop, {"lut", "ior", "--axes", "f0,mu,roughness", "--channels", "scale", "--size", "6x500",
               "--depth", "100", "-j", name[0] == 'a' ? "1" : "3", "--json", "-o", file});
    EXPECT_EQ(outcome.code, 0) << name << outcome.err;
    images.push_back(read_image(file).image);
    ASSERT_EQ(images.back().size, (Size{6, 50000}));
    for (int y = 0; y < 50000; ++y) {
      for (int x = 0; x < 6; ++x) {
        ASSERT_EQ(images.back().layers[0].plane.at(x, y), images[0].layers[0].plane.at(x, y))
            << name << " " << x << " " << y;
      }
    }
  }
  EXPECT_EQ(test::text_of(shop / "a.exr"), test::text_of(shop / "b.exr"));
  const auto json = nlohmann::json::parse(test::text_of(shop / "a.dds.json"));
  EXPECT_EQ(json["kiln:depth"], "100");
  EXPECT_THAT(json["kiln:entry_error"].get<std::string>(), HasSubstr("greatest of 125 entries"));
}

TEST(LutVerb, TakesThePresetsTypeWhereTheFormatHoldsIt) {
  const Workshop shop;
  const std::string exr = (shop / "a.exr").string(), png = (shop / "a.png").string();
  const std::vector<std::string> words = {"lut", "split-sum", "--preset", "filament", "-o"};
  auto with = [&](const std::string& file) {
    auto all = words;
    all.push_back(file);
    return all;
  };
  const Outcome outcome = kiln(shop, with(exr));
  EXPECT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.err, HasSubstr("cmgen writes each row"));
  EXPECT_EQ(kiln(shop, with(png)).code, 0);
  EXPECT_EQ(inspect_image(exr).type, PixelType::Half);
  EXPECT_EQ(inspect_image(png).type, PixelType::Uint16);
}

TEST(LutVerb, PrintsCodeThatLooksTheTableUp) {
  const Workshop shop;
  const Outcome outcome =
      kiln(shop, {"lut", "split-sum", "--preset", "unity-hdrp", "--snippet", "glsl"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("vec3 kiln_split_sum(sampler2D table, float mu, "
                                     "float roughness)"));
  EXPECT_EQ(kiln(shop, {"lut", "split-sum", "--snippet", "rust"}).code, 2);
}

TEST(LutVerb, IntegratesAnyLobeAtAPoint) {
  const Workshop shop;
  const Outcome outcome = kiln(shop, {"lut", "directional-albedo", "--distribution", "phong",
                                      "--masking", "implicit", "--at", "0.3,1"});
  EXPECT_NEAR(std::stod(outcome.out), 0.25, 1e-12);  // for every direction
  const Outcome solid = kiln(shop, {"lut", "ior", "--at", "0.5,0.3,0.04", "--json"});
  EXPECT_EQ(nlohmann::json::parse(solid.out)["f0"], 0.04);
}

TEST(LutVerb, RefusesWhatDoesNotFitBeforeItIntegrates) {
  const Workshop shop;
  const std::string file = (shop / "a.exr").string();
  const auto refuses = [&](std::vector<std::string> words, const char* message) {
    words.insert(words.begin(), {"lut", "split-sum", "-o", file});
    const Outcome outcome = kiln(shop, words);
    EXPECT_EQ(outcome.code, 2) << message;
    EXPECT_THAT(outcome.err, HasSubstr(message));
  };
  refuses({"--masking", "smith"}, "unknown masking 'smith'");
  refuses({"--masking", "estevez-kulla"}, "does not fit");
  refuses({"--axes", "mu,rougness"}, "did you mean 'roughness'?");
  refuses({"--channels", "scale,bais"}, "did you mean 'bias'?");
  refuses({"--preset", "filamant"}, "did you mean 'filament'?");
  refuses({"--preset", "cycles"}, "cycles has no table 'split-sum'");
  refuses({"--type", "rgbd8"}, "openexr does not hold rgbd8");
}

TEST(VerifyVerb, RecognisesATableAndItsErrors) {
  const Workshop shop;
  const std::string file = (shop / "a.npy").string(), map = (shop / "map.png").string();
  EXPECT_EQ(kiln(shop, {"lut", "split-sum", "--preset", "three", "--size", "32", "-o", file}).code,
            0);
  const Outcome outcome = kiln(shop, {"verify", file, "--map", map});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("a.npy: split-sum"), HasSubstr("x = roughness"),
                                 HasSubstr("presets       three")));
  EXPECT_TRUE(std::filesystem::exists(map));
  const auto json = nlohmann::json::parse(kiln(shop, {"verify", file, "--json"}).out);
  EXPECT_TRUE(json["fits"].get<bool>());
  EXPECT_LT(json["best"]["max_error"].get<double>(), 3e-4);  // of halves
}

TEST(VerifyVerb, EndsWithSevenBeyondTheErrorAllowed) {
  const Workshop shop;
  const std::string file = (shop / "a.png").string();
  EXPECT_EQ(kiln(shop, {"lut", "split-sum", "--size", "32", "--type", "uint8", "-o", file}).code,
            0);
  EXPECT_EQ(kiln(shop, {"verify", file, "--max-error", "0.01"}).code, 0);
  EXPECT_EQ(kiln(shop, {"verify", file, "--max-error", "1e-5"}).code, 7);
}

TEST(VerifyVerb, NeverGuessesWhatIsNoTable) {
  const Workshop shop;
  std::string text = "x,y\n";
  for (int i = 0; i < 256; ++i) text += std::to_string(i % 7) + "," + std::to_string(i % 5) + "\n";
  shop.write("numbers.csv", text);
  const Outcome outcome = kiln(shop, {"verify", (shop / "numbers.csv").string()});
  EXPECT_EQ(outcome.code, 7);
  EXPECT_THAT(outcome.out, HasSubstr("no convention fits"));
  shop.write("prose.txt", "no numbers here");
  EXPECT_EQ(kiln(shop, {"verify", (shop / "prose.txt").string()}).code, 3);
  EXPECT_EQ(kiln(shop, {"verify", (shop / "absent.exr").string()}).code, 3);
}

TEST(ListVerb, SaysWhatModelsDoWithEnergy) {
  const Workshop shop;
  EXPECT_THAT(kiln(shop, {"list", "charlie"}).out, HasSubstr("GAINS ENERGY"));
  EXPECT_THAT(kiln(shop, {"list", "schlick-ggx"}).out, HasSubstr("FAILS"));
  EXPECT_THAT(kiln(shop, {"list", "ggx"}).out,
              AllOf(HasSubstr("passes"), HasSubstr("alpha_x"), Not(HasSubstr("GAINS"))));
  EXPECT_THAT(kiln(shop, {"list", "presets"}).out, HasSubstr("unity-hdrp"));
}

}  // namespace
}  // namespace kiln

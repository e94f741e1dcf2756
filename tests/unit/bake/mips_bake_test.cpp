// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "kiln/bake/bake.h"
#include "kiln/image/mip_levels.h"
#include "kiln/math/hash.h"
#include "support/faults.h"
#include "support/images.h"

namespace kiln {
namespace {

using test::greatest_difference;
using testing::HasSubstr;

using Images = std::map<Slot, Layers>;

float hashed(uint32_t seed, int x, int y) {
  const uint32_t bits =
      combine_hash(combine_hash(seed, static_cast<uint32_t>(x)), static_cast<uint32_t>(y));
  return static_cast<float>(bits >> 8) / 16777216.0f;
}

Layers noise(Size size, const std::vector<std::string>& names, uint32_t seed) {
  Layers image = make_layers(size, names);
  for (Layer& layer : image.layers) {
    ++seed;
    for (int y = 0; y < size.height; ++y) {
      for (int x = 0; x < size.width; ++x) layer.plane.at(x, y) = hashed(seed, x, y);
    }
  }
  return image;
}

// Normals about +z, stored.
Layers bumps(Size size, float slope) {
  Layers image = noise(size, {"R", "G", "B"}, 77);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const float sx = slope * (2 * image.layers[0].plane.at(x, y) - 1);
      const float sy = slope * (2 * image.layers[1].plane.at(x, y) - 1);
      const float z = 1 / std::sqrt(1 + sx * sx + sy * sy);
      image.layers[0].plane.at(x, y) = 0.5f + 0.5f * sx * z;
      image.layers[1].plane.at(x, y) = 0.5f + 0.5f * sy * z;
      image.layers[2].plane.at(x, y) = 0.5f + 0.5f * z;
    }
  }
  return image;
}

Layers constant(Size size, const std::vector<std::string>& names, float value) {
  Layers image = make_layers(size, names);
  for (Layer& layer : image.layers) layer.plane = Plane(size, value);
  return image;
}

// The texel that was at (x, y) comes to (x + dx, y + dy).
Layers rolled(const Layers& image, int dx, int dy) {
  Layers result = image;
  for (size_t c = 0; c < image.layers.size(); ++c) {
    for (int y = 0; y < image.size.height; ++y) {
      for (int x = 0; x < image.size.width; ++x) {
        result.layers[c].plane.at((x + dx) % image.size.width, (y + dy) % image.size.height) =
            image.layers[c].plane.at(x, y);
      }
    }
  }
  return result;
}

Layers rows_of(const Layers& image, RowRange rows) {
  Layers band{{image.size.width, rows.count}, {}};
  for (const Layer& layer : image.layers) {
    Plane& plane = band.add(layer.name);
    for (int y = 0; y < rows.count; ++y) {
      const auto row = layer.plane.texels_of_row(rows.first + y);
      std::copy(row.begin(), row.end(), plane.row(y));
    }
  }
  return band;
}

// A set in memory, whose colours are linear and whose files are named after their slots.
MapBands set_of(const Images& images, float roughness = -1) {
  MapBands set;
  set.name = "set";
  set.working = "lin_rec709_scene";
  set.size = images.begin()->second.size;
  for (const auto& [slot, image] : images) {
    const bool color = slot_facts(slot).content == Content::Color;
    set.given.push_back({slot, std::string(slot_name(slot)), false, image.size,
                         static_cast<int>(image.layers.size()), "uint8",
                         color ? "lin_rec709_scene" : ""});
  }
  if (roughness >= 0) set.given.push_back({Slot::Roughness, "constant", true, {1, 1}, 1, "", ""});
  if (images.count(Slot::Normal)) {
    set.normal = NormalForm{{NormalConvention::OpenGl, NormalZero::Both, NormalRange::Unsigned,
                             NormalLayout::ThreeChannel},
                            {},
                            {}};
  }
  const auto read = [images, roughness](const MapRows& rows, bool colors_only) {
    SlotMaps maps;
    for (const auto& [slot, image] : images) {
      if (colors_only && slot_facts(slot).content != Content::Color) continue;
      maps[slot].image = rows_of(image, rows.rows);
    }
    if (roughness >= 0 && !colors_only) maps[Slot::Roughness].value = {roughness, 0, 0};
    return maps;
  };
  set.stored = [read](const MapRows& rows) { return read(rows, false); };
  set.linear = [read](const MapRows& rows) { return read(rows, true); };
  set.whole = [images](Slot slot) { return images.at(slot); };
  return set;
}

/// What became of a set: levels by the name of the file.
struct Made {
  std::map<std::string, std::vector<Layers>> levels;
  std::map<std::string, double> figures;
  std::vector<MipFile> files;
};

using Words = std::vector<std::pair<std::string, std::string>>;

Baked baked(const MapBands& set, const Words& settings) {
  const auto recipe = make_recipe("mips");
  for (const auto& [name, text] : settings) recipe->set(name, text);
  recipe->needs();
  Ingredients ingredients;
  ingredients.maps = &set;
  return recipe->bake(ingredients);
}

Made made_of(const MapBands& set, const Words& settings, int band_rows = 64) {
  const Baked result = baked(set, settings);
  const MipSheet& sheet = *result.mips;
  Made made;
  made.files = sheet.files;
  const std::vector<Size> sizes = level_sizes(sheet.size, sheet.levels);
  for (const MipFile& file : sheet.files) {
    for (const Size size : sizes) made.levels[file.name].push_back(make_layers(size, file.names));
  }
  std::map<std::pair<size_t, int>, int> filled;
  for (int first = 0; first < sheet.size.height; first += band_rows) {
    MapRows rows;
    rows.rows = {first, std::min(band_rows, sheet.size.height - first)};
    const auto band = sheet.read(rows);
    for (const MipRows& part : sheet.filter(band.get())) {
      Layers& level = made.levels[sheet.files[part.file].name][static_cast<size_t>(part.level)];
      int& at = filled[{part.file, part.level}];
      for (size_t c = 0; c < level.layers.size(); ++c) {
        for (int y = 0; y < part.image.size.height; ++y) {
          const auto row = part.image.layers[c].plane.texels_of_row(y);
          std::copy(row.begin(), row.end(), level.layers[c].plane.row(at + y));
        }
      }
      at += part.image.size.height;
    }
  }
  for (const auto& [place, rows] : filled) {
    EXPECT_EQ(rows, sizes[static_cast<size_t>(place.second)].height);
  }
  EXPECT_EQ(filled.size(), sheet.files.size() * sizes.size());
  for (const auto& [name, value] : sheet.figures()) made.figures[name] = value;
  return made;
}

TEST(MipsBake, KeepsTheFirstLevelAsItIs) {
  const Images images{{Slot::BaseColor, noise({48, 40}, {"R", "G", "B"}, 1)},
                      {Slot::Normal, bumps({48, 40}, 0.3f)},
                      {Slot::Roughness, noise({48, 40}, {"G"}, 5)},
                      {Slot::Metallic, noise({48, 40}, {"B"}, 6)}};
  const Made made = made_of(set_of(images), {});
  ASSERT_EQ(made.files.size(), 4u);
  for (const auto& [slot, image] : images) {
    EXPECT_EQ(greatest_difference(image, made.levels.at(std::string(slot_name(slot)))[0]), 0);
  }
}

TEST(MipsBake, AveragesAlphaSquaredAndNotRoughness) {
  Layers roughness = make_layers({2, 1}, {"Y"});
  roughness.layers[0].plane.at(0, 0) = 0.2f;
  roughness.layers[0].plane.at(1, 0) = 0.8f;
  const Made made = made_of(set_of({{Slot::Roughness, roughness}}), {});
  EXPECT_NEAR(made.levels.at("roughness")[1].layers[0].plane.at(0, 0),
              std::pow((std::pow(0.2, 4) + std::pow(0.8, 4)) / 2, 0.25), 1e-6);
}

TEST(MipsBake, ChangesNothingWhereNormalsAreFlat) {
  const Size size{37, 20};
  Layers flat = constant(size, {"R", "G", "B"}, 0.5f);
  flat.layers[2].plane = Plane(size, 1.0f);
  for (const char* method : {"none", "toksvig", "vmf", "lean"}) {
    const Made made =
        made_of(set_of({{Slot::Normal, flat}, {Slot::Roughness, constant(size, {"Y"}, 0.37f)}}),
                {{"method", method}});
    for (const Layers& level : made.levels.at("roughness")) {
      EXPECT_LE(greatest_difference(constant(level.size, {"Y"}, 0.37f), level), 2e-7) << method;
    }
    for (const Layers& level : made.levels.at("normal")) {
      EXPECT_LE(std::abs(level.layers[0].plane.at(0, 0) - 0.5f), 1e-7) << method;
      EXPECT_LE(std::abs(level.layers[2].plane.at(0, 0) - 1.0f), 1e-7) << method;
    }
  }
}

// Independent slopes of the variance v: the moments of every level estimate it.
TEST(MipsBake, WidensRoughnessByTheVarianceOfSlopes) {
  const Size size{256, 256};
  const double slope = 0.2, variance = slope * slope / 3;
  const Made made =
      made_of(set_of({{Slot::Normal, bumps(size, slope)}}, 0.3f), {{"method", "lean"}});
  const double expected = std::pow(0.3, 4) + 2 * variance;
  for (const int level : {4, 6, 8}) {
    const std::string name = "roughness, level " + std::to_string(level) + ": mean alpha^2";
    EXPECT_NEAR(made.figures.at(name), expected, 0.02 * expected) << name;
  }
  EXPECT_NEAR(made.figures.at("roughness, level 0: mean alpha^2"), std::pow(0.3, 4), 1e-6);
  EXPECT_LT(made.figures.at("lobes, level 5: rms error of the density, median"), 0.4);
}

TEST(MipsBake, RollsEveryFileWithItsInput) {
  const Size size{64, 32};
  const Images images{{Slot::BaseColor, noise(size, {"R", "G", "B"}, 1)},
                      {Slot::Normal, bumps(size, 0.4f)},
                      {Slot::Roughness, noise(size, {"G"}, 5)},
                      {Slot::Opacity, noise(size, {"A"}, 9)},
                      {Slot::AnisotropyAngle, noise(size, {"Y"}, 10)}};
  Images moved;
  for (const auto& [slot, image] : images) moved[slot] = rolled(image, 24, 8);
  for (const char* method : {"toksvig", "vmf", "lean"}) {
    const Words settings{{"method", method}, {"alpha_test", "0.5"}};
    const Made made = made_of(set_of(images), settings);
    const Made of_moved = made_of(set_of(moved), settings, 16);
    for (const auto& [name, levels] : made.levels) {
      for (size_t l = 0; l <= 3; ++l) {
        EXPECT_EQ(
            greatest_difference(rolled(levels[l], 24 >> l, 8 >> l), of_moved.levels.at(name)[l]), 0)
            << name << " " << l;
      }
    }
  }
}

TEST(MipsBake, TakesAnySizeHoweverTheRowsCome) {
  for (const Size size : {Size{61, 47}, Size{1, 37}, Size{53, 1}, Size{2, 130}}) {
    const Images images{{Slot::BaseColor, noise(size, {"R", "G", "B"}, 1)},
                        {Slot::Normal, bumps(size, 0.4f)},
                        {Slot::Roughness, noise(size, {"G"}, 5)},
                        {Slot::Opacity, noise(size, {"A"}, 9)}};
    const Made whole = made_of(set_of(images), {{"method", "lean"}, {"anisotropy", "true"}}, 1000);
    const Made banded = made_of(set_of(images), {{"method", "lean"}, {"anisotropy", "true"}}, 8);
    for (const auto& [name, levels] : whole.levels) {
      for (size_t l = 0; l < levels.size(); ++l) {
        EXPECT_EQ(greatest_difference(levels[l], banded.levels.at(name)[l]), 0) << name << l;
      }
    }
  }
}

TEST(MipsBake, WeighsColourByOpacity) {
  Layers color = make_layers({2, 2}, {"R", "G", "B"});
  Layers opacity = make_layers({2, 2}, {"A"});
  color.layers[0].plane.at(0, 0) = 0.8f;  // opaque and red; the others are clear and green
  opacity.layers[0].plane.at(0, 0) = 1;
  for (const auto& [x, y] : {std::pair{1, 0}, {0, 1}, {1, 1}}) color.layers[1].plane.at(x, y) = 1;
  const Made made = made_of(set_of({{Slot::BaseColor, color}, {Slot::Opacity, opacity}}), {});
  const Layers& level = made.levels.at("base_color")[1];
  EXPECT_NEAR(level.layers[0].plane.at(0, 0), 0.8f, 1e-5);
  EXPECT_NEAR(level.layers[1].plane.at(0, 0), 0, 1e-5);
  EXPECT_EQ(made.levels.at("opacity")[1].layers[0].plane.at(0, 0), 0.25f);
}

TEST(MipsBake, KeepsColourWhereAllIsClear) {
  const Size size{4, 4};
  const Made made = made_of(set_of({{Slot::BaseColor, constant(size, {"R", "G", "B"}, 0.3f)},
                                    {Slot::Opacity, constant(size, {"A"}, 0)}}),
                            {});
  EXPECT_NEAR(made.levels.at("base_color")[2].layers[0].plane.at(0, 0), 0.3f, 1e-6);
}

TEST(MipsBake, PutsOpacityBesideColourWhereItsFileHasIt) {
  const Size size{8, 8};
  MapBands set = set_of(
      {{Slot::BaseColor, noise(size, {"R", "G", "B"}, 1)}, {Slot::Opacity, noise(size, {"A"}, 9)}});
  for (GivenMap& map : set.given) map.source = "leaf.png";
  const Made made = made_of(set, {});
  ASSERT_EQ(made.files.size(), 1u);
  EXPECT_THAT(made.files[0].names, testing::ElementsAre("R", "G", "B", "A"));
  const Plane whole = next_level(set.whole(Slot::Opacity).layers[0].plane);
  EXPECT_NEAR(made.levels.at("base_color")[1].layers[3].plane.at(2, 3), whole.at(2, 3), 2e-6);
}

TEST(MipsBake, KeepsTheCoverageOfCutouts) {
  const Size size{128, 128};
  Layers leaves = make_layers(size, {"A"});
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const float wave = 0.5f + 0.5f * std::sin(0.53f * x) * std::sin(0.61f * y);
      leaves.layers[0].plane.at(x, y) = std::clamp(4 * (wave - 0.72f) + 0.5f, 0.0f, 1.0f);
    }
  }
  const auto coverage = [](const Layers& level) {
    double solid = 0;
    for (int y = 0; y < level.size.height; ++y) {
      for (const float v : level.layers[0].plane.texels_of_row(y)) solid += v > 0.5f;
    }
    return solid / static_cast<double>(area(level.size));
  };
  const MapBands set = set_of({{Slot::Opacity, leaves}});
  const Made kept = made_of(set, {{"alpha_test", "0.5"}}), plain = made_of(set, {});
  const double share = coverage(leaves);
  for (size_t l = 1; l <= 4; ++l) {
    EXPECT_NEAR(coverage(kept.levels.at("opacity")[l]), share, 0.02) << l;
  }
  EXPECT_LT(coverage(plain.levels.at("opacity")[4]), 0.5 * share);
}

TEST(MipsBake, WritesGlossWhereGlossIsGiven) {
  const Size size{8, 8};
  const Layers gloss = noise(size, {"A"}, 3);
  const Made made = made_of(set_of({{Slot::Gloss, gloss}}), {});
  const Made roughness = made_of(set_of({{Slot::Gloss, gloss}}), {{"map", "roughness"}});
  for (size_t l = 0; l < 4; ++l) {
    EXPECT_NEAR(made.levels.at("gloss")[l].layers[0].plane.at(0, 0),
                1 - roughness.levels.at("roughness")[l].layers[0].plane.at(0, 0), 1e-6);
  }
}

TEST(MipsBake, AveragesAnglesOfAnisotropyAsLinesAndNotAsNumbers) {
  Layers angle = make_layers({2, 1}, {"Y"});
  angle.layers[0].plane.at(0, 0) = 0.02f;  // turns: 7 degrees
  angle.layers[0].plane.at(1, 0) = 0.46f;  // 166 degrees, which is -14
  const Made made = made_of(set_of({{Slot::AnisotropyAngle, angle}}), {});
  EXPECT_NEAR(made.levels.at("anisotropy_angle")[1].layers[0].plane.at(0, 0), 0.49f, 1e-5);
}

TEST(MipsBake, MakesTheMapsThatAreAskedFor) {
  const Size size{8, 8};
  const MapBands set = set_of({{Slot::BaseColor, noise(size, {"R", "G", "B"}, 1)},
                               {Slot::Normal, bumps(size, 0.4f)},
                               {Slot::Roughness, noise(size, {"G"}, 5)}});
  const Made made = made_of(set, {{"map", "roughness,normal"}, {"levels", "2"}});
  ASSERT_EQ(made.files.size(), 2u);
  EXPECT_EQ(made.levels.at("roughness").size(), 2u);
  EXPECT_EQ(make_recipe("mips")->needs().maps.stored.size(), slot_list.size());
}

TEST(MipsBake, RefusesWhatDoesNotFit) {
  const auto refusal = [](const MapBands& set, const Words& settings) {
    try {
      baked(set, settings);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  const MapBands normals = set_of({{Slot::Normal, bumps({4, 4}, 0.1f)}});
  EXPECT_THAT(refusal(normals, {{"map", "roughness"}}), HasSubstr("no map of roughness or gloss"));
  EXPECT_THAT(refusal(normals, {{"map", "metallic"}}), HasSubstr("the set has no metallic"));
  EXPECT_THAT(refusal(normals, {{"map", "ruffness"}}), HasSubstr("roughness"));
  EXPECT_THAT(refusal(normals, {{"anisotropy", "true"}}), HasSubstr("expected lean"));
}

}  // namespace
}  // namespace kiln

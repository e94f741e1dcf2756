// SPDX-License-Identifier: Apache-2.0
// A plane with a pixel a texel, made a band of rows at a time.
#include <gtest/gtest.h>

#include "kiln/math/hash.h"
#include "kiln/parallel/rows.h"
#include "support/scenes.h"

namespace kiln {
namespace {

using test::Settings;

constexpr Size set_size{45, 150};  // neither is a multiple of a block

Layers sky_with_lamp() {
  return test::make_latlong({128, 64}, [](const Vec3<double>& d) {
    return (dot(d, {0, 0.6, 0.8}) > 0.97 ? 40.0 : 0.2) + 0.1 * d.x;
  });
}

Svbrdf hashed_set() {
  Svbrdf s = test::uniform_svbrdf({.size = set_size});
  s.anisotropy = s.anisotropy_angle = Plane(set_size);
  const auto number = [](uint32_t plane, int x, int y) {
    const auto texel = static_cast<uint32_t>(y * set_size.width + x);
    return static_cast<float>(combine_hash(plane, texel) % 1000) / 1000;
  };
  for (int y = 0; y < set_size.height; ++y) {
    for (int x = 0; x < set_size.width; ++x) {
      s.roughness.at(x, y) = 0.2f + 0.8f * number(1, x, y);
      s.f0[0].at(x, y) = number(2, x, y);
      s.diffuse_color[1].at(x, y) = 0.5f * number(3, x, y);
      s.normal[0].at(x, y) = 0.4f * number(4, x, y) - 0.2f;
      s.anisotropy.at(x, y) = y < 40 ? number(5, x, y) : 0;
      s.anisotropy_angle.at(x, y) = 3 * number(6, x, y);
    }
  }
  return s;
}

Plane rows_of(const Plane& whole, RowRange rows) {
  Plane band({whole.width(), rows.count});
  for (int y = 0; y < rows.count; ++y) {
    const auto row = whole.texels_of_row(rows.first + y);
    std::copy(row.begin(), row.end(), band.row(y));
  }
  return band;
}

Svbrdf rows_of(const Svbrdf& whole, RowRange rows) {
  Svbrdf band = whole;
  band.size = {whole.size.width, rows.count};
  for (auto* three : {&band.diffuse_color, &band.f0, &band.normal}) {
    for (Plane& plane : *three) plane = rows_of(plane, rows);
  }
  for (Plane* one :
       {&band.roughness, &band.ambient_occlusion, &band.anisotropy, &band.anisotropy_angle}) {
    *one = rows_of(*one, rows);
  }
  return band;
}

MapBands bands_of(const Svbrdf& set) {
  MapBands bands;
  bands.size = set.size;
  bands.given.emplace_back().slot = Slot::Anisotropy;
  bands.svbrdf = [&set](const MapRows& rows) { return rows_of(set, rows.rows); };
  return bands;
}

// Bands in any order, all at once.
Layers assembled(const MapSheet& sheet, int band_rows) {
  const int bands = (set_size.height + band_rows - 1) / band_rows;
  Layers whole{set_size, {}};
  for (const Layer& layer : sheet.files.at(0).image.layers) whole.add(layer.name);
  for_rows(bands, [&](int i) {
    MapRows rows;
    rows.rows = {i * band_rows, std::min(band_rows, set_size.height - i * band_rows)};
    const Layers made = sheet.make(rows).at(0);
    ASSERT_EQ(made.layers.size(), whole.layers.size());
    for (size_t l = 0; l < made.layers.size(); ++l) {
      ASSERT_EQ(made.layers[l].name, whole.layers[l].name);
      for (int y = 0; y < rows.rows.count; ++y) {
        const auto row = made.layers[l].plane.texels_of_row(y);
        std::copy(row.begin(), row.end(), whole.layers[l].plane.row(rows.rows.first + y));
      }
    }
  });
  return whole;
}

void expect_same(const Layers& a, const Layers& b) {
  ASSERT_EQ(a.size, b.size);
  ASSERT_EQ(a.layers.size(), b.layers.size());
  for (size_t l = 0; l < a.layers.size(); ++l) {
    ASSERT_EQ(a.layers[l].name, b.layers[l].name);
    for (int y = 0; y < a.size.height; ++y) {
      const auto left = a.layers[l].plane.texels_of_row(y),
                 right = b.layers[l].plane.texels_of_row(y);
      ASSERT_TRUE(std::equal(left.begin(), left.end(), right.begin())) << a.layers[l].name << y;
    }
  }
}

struct Kind {
  std::string name;
  Settings settings;
  SurfaceChoice surface = {};
};

std::vector<Kind> all_kinds() {
  SurfaceChoice beckmann, glass;
  beckmann.distribution = "beckmann";
  glass.bsdf = "glass";
  return {
      {"reference", {{"samples", "16"}, {"view", "50,20"}, {"seed", "3"}}},
      {"target error", {{"samples", "16"}, {"target_error", "0.02"}}},
      {"split-sum", {{"mode", "split-sum"}, {"rotate", "30"}}},
      {"difference", {{"mode", "difference"}, {"samples", "16"}, {"lights", "dir:1,1,1:3,3,3"}}},
      {"staged", {{"mode", "difference"}, {"samples", "16"}}, beckmann},
      {"glass", {{"samples", "16"}}, glass}};
}

class PreviewBands : public testing::TestWithParam<Kind> {};

TEST_P(PreviewBands, AreThePictureAndTheFiguresOfTheWholeSetToTheBit) {
  const auto& [name, settings, surface] = GetParam();
  const Svbrdf set = hashed_set();
  const Layers sky = sky_with_lamp();
  const Baked whole = test::bake_preview(set, sky, settings, surface);
  const MapBands maps = bands_of(set);
  Ingredients ingredients;
  ingredients.maps = &maps;
  for (const int rows : {band_unit, 3 * band_unit, 10 * band_unit}) {
    const auto scene = test::bake_scene(ingredients, sky, settings, surface);
    EXPECT_TRUE(scene.baked.artifacts.empty());
    const MapSheet& sheet = *scene.baked.sheet;
    EXPECT_EQ(sheet.files.at(0).attributes, whole.artifacts.at(0).attributes);
    const Layers image = assembled(sheet, rows);
    expect_same(image, whole.artifacts.at(0).image);
    const Told told = sheet.told();
    EXPECT_EQ(told.figures, whole.figures);
    std::vector<std::string> notes = scene.baked.notes;
    notes.insert(notes.end(), told.notes.begin(), told.notes.end());
    EXPECT_EQ(notes, whole.notes);
    ASSERT_EQ(sheet.view.has_value(), whole.artifacts.at(0).view.has_value());
    if (!sheet.view) continue;
    const ImageBands view = sheet.view->paint(sheet.view->keep(image));
    expect_same(view.make(0, view.size.height), *whole.artifacts.at(0).view);
  }
}

INSTANTIATE_TEST_SUITE_P(OfEveryKind, PreviewBands, testing::ValuesIn(all_kinds()),
                         [](const auto& of) {
                           std::string name = of.param.name;
                           std::replace_if(
                               name.begin(), name.end(), [](char c) { return !std::isalnum(c); },
                               '_');
                           return name;
                         });

TEST(PreviewNeeds, AreBandsOfMapsWhereAPixelIsATexel) {
  const auto needs = [](const Settings& settings) {
    const auto recipe = make_recipe("preview");
    for (const auto& [name, value] : settings) recipe->set(name, value);
    return recipe->needs();
  };
  EXPECT_TRUE(needs({}).maps.resolved);
  EXPECT_FALSE(needs({}).material);
  EXPECT_FALSE(needs({}).late_view);
  EXPECT_TRUE(needs({{"mode", "difference"}}).late_view);
  for (const Settings& other :
       {Settings{{"size", "64"}}, Settings{{"shape", "sphere"}}, Settings{{"shape", "contact"}}}) {
    EXPECT_FALSE(needs(other).maps.any());
    EXPECT_TRUE(needs(other).material);
  }
}

}  // namespace
}  // namespace kiln

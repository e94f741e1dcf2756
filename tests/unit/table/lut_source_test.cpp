// SPDX-License-Identifier: Apache-2.0
// Volumes that are made a few slices at a time.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "kiln/parallel/threads.h"
#include "kiln/table/lut.h"

namespace kiln {
namespace {

struct Layout {
  std::vector<std::string> axes, channels;
  Size size;
  int depth;
};

TableRecipe recipe_of(const Layout& layout) {
  TableRecipe recipe = kiln::recipe_of(find_table("ior"));
  recipe.axes = layout.axes;
  recipe.channels = layout.channels;
  recipe.size = layout.size;
  recipe.depth = layout.depth;
  complete(recipe);
  return recipe;
}

// More entries than are made at once, cheap ones: fields over n.v and roughness, closed forms.
const std::vector<Layout>& large_volumes() {
  static const std::vector<Layout> layouts = {
      {{"f0", "mu", "roughness"}, {"scale", "average", "one"}, {5, 600}, 97},
      {{"f0", "roughness", "mu"}, {"bias", "diffuse-lambert", "average"}, {7, 90}, 500},
      {{"mu", "roughness", "f0"}, {"total", "zero"}, {80, 70}, 50},
  };
  return layouts;
}

LutIndices all_indices(const LutSource& source) {
  LutIndices indices;
  for (const TableAxis& axis : source.axes()) {
    indices.emplace_back(axis.count);
    std::iota(indices.back().begin(), indices.back().end(), 0);
  }
  return indices;
}

// Slices from the first to the last, so many at once.
std::vector<float> in_groups(LutSource& source, int at_once) {
  std::vector<float> values;
  for (int first = 0; first < source.slices(); first += at_once) {
    const Layers image = source.image(first, std::min(at_once, source.slices() - first));
    for (int y = 0; y < image.size.height; ++y) {
      for (const Layer& layer : image.layers) {
        const auto row = layer.plane.texels_of_row(y);
        values.insert(values.end(), row.begin(), row.end());
      }
    }
  }
  return values;
}

TEST(Volumes, AreTheSameBitsInSlicesAsWhole) {
  for (const Layout& layout : large_volumes()) {
    LutSource source(recipe_of(layout));
    ASSERT_LT(source.slices_at_once(), source.slices());
    const LutEntries whole = source.entries(all_indices(source));
    LutSource fresh(recipe_of(layout));
    const std::vector<float> values = in_groups(fresh, fresh.slices_at_once());
    ASSERT_EQ(values.size(), whole.size() * whole[0].size());
    size_t different = 0;
    const auto width = static_cast<size_t>(layout.size.width);
    for (size_t i = 0; i < values.size(); ++i) {
      const size_t row = i / width, channel = row % whole.size(), y = row / whole.size();
      if (values[i] != static_cast<float>(whole[channel][y * width + i % width])) ++different;
    }
    EXPECT_EQ(different, 0u) << layout.axes[2];
  }
}

TEST(Volumes, AreTheSameBitsForAnyNumberOfThreadsAndSlicesAtOnce) {
  const Layout& layout = large_volumes()[1];
  const auto make = [&](int threads, int at_once) {
    const ThreadLimit limit(threads);
    LutSource source(recipe_of(layout));
    return in_groups(source, at_once);
  };
  const std::vector<float> expected = make(1, 416);
  EXPECT_EQ(make(4, 416), expected);
  EXPECT_EQ(make(2, 1), expected);
}

TEST(Volumes, AreMadeInPartsOfABoundedNumberOfEntries) {
  for (const Layout& layout : large_volumes()) {
    const LutSource source(recipe_of(layout));
    EXPECT_LE(area(layout.size) * source.slices_at_once(), 1 << 18);
    EXPECT_EQ(source.slices(), layout.depth);
  }
  EXPECT_EQ(
      LutSource(recipe_of({{"f0", "roughness", "mu"}, {"zero"}, {1024, 1024}, 9})).slices_at_once(),
      1);
}

// The value between eight entries, straight from the definition.
double trilinear(const LutSource& source, const std::vector<double>& entries,
                 const std::vector<double>& point) {
  size_t index = 0, step = 1;
  std::vector<double> blend;
  std::vector<size_t> steps;
  for (size_t a = 0; a < 3; ++a) {
    const TableAxis& axis = source.axes()[a];
    const double at = axis.mapping.position(point[a]) * axis.count - 0.5;
    index += step * static_cast<size_t>(at);
    blend.push_back(at - std::floor(at));
    steps.push_back(step);
    step *= static_cast<size_t>(axis.count);
  }
  double sum = 0;
  for (unsigned corner = 0; corner < 8; ++corner) {
    double weight = 1;
    size_t at = index;
    for (size_t a = 0; a < 3; ++a) {
      const bool next = (corner >> a & 1) != 0;
      weight *= next ? blend[a] : 1 - blend[a];
      at += next ? steps[a] : 0;
    }
    sum += weight * entries[at];
  }
  return sum;
}

TEST(Volumes, AreLookedUpThroughTheFewEntriesAround) {
  for (const Layout& layout : large_volumes()) {
    LutSource source(recipe_of(layout));
    const LutEntries whole = source.entries(all_indices(source));
    for (const double at : {0.21, 0.5, 0.83}) {
      const std::vector<double> values = look_up(source, {at, 0.9 * at, 1.1 * at});
      for (size_t c = 0; c < values.size(); ++c) {
        EXPECT_NEAR(values[c], trilinear(source, whole[c], {at, 0.9 * at, 1.1 * at}), 1e-12);
      }
    }
  }
}

TEST(Volumes, StateTheErrorsOfTheirEntriesAndLookups) {
  for (const Layout& layout : large_volumes()) {
    LutSource source(recipe_of(layout));
    const LutErrors errors = errors_of(source);
    EXPECT_EQ(errors.entries_checked, 125);
    EXPECT_GT(errors.entry, 0);
    EXPECT_LE(errors.entry, 1e-6);
    EXPECT_GT(errors.lookup, 1e-3);
    EXPECT_LE(errors.lookup_inner, errors.lookup);
  }
}

// Fits follow each other along n.v, which is the third axis here: they are made at once.
TEST(Volumes, FitTheirFitsAsAWhole) {
  LutSource source(recipe_of({{"f0", "roughness", "mu"}, {"ltc-m11", "zero"}, {8000, 3}, 12}));
  ASSERT_LT(source.slices_at_once(), source.slices());
  LutSource small(recipe_of({{"f0", "roughness", "mu"}, {"ltc-m11", "zero"}, {2, 3}, 12}));
  EXPECT_EQ(source.fit_error(), small.fit_error());
  const Layers last = source.image(11, 1), expected = small.image(11, 1);
  for (int y = 0; y < 3; ++y) {
    EXPECT_EQ(last.layers[0].plane.at(7999, y), expected.layers[0].plane.at(0, y));
  }
}

TEST(LobeCaches, DropWhatTheLastRoundDidNotAskForUnlessItIsKept) {
  LobeCache lobes(Quality::Table, 1e-3);
  const auto ask = [&](double ior) {
    FresnelChoice fresnel{"dielectric", {}};
    fresnel.parameters.ior = ior;
    lobes.of({}, fresnel);
  };
  ask(1.1);
  lobes.keep();
  ask(1.2);
  ask(1.3);
  lobes.drop_unused();
  EXPECT_EQ(lobes.size(), 3u);  // all were asked for
  ask(1.3);
  ask(1.4);
  lobes.drop_unused();
  EXPECT_EQ(lobes.size(), 3u);  // 1.1 is kept, 1.2 gone
  lobes.drop_unused();
  EXPECT_EQ(lobes.size(), 1u);
}

}  // namespace
}  // namespace kiln

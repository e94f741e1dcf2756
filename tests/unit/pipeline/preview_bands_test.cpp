// SPDX-License-Identifier: Apache-2.0
// Previews with a pixel a texel, from files to files.
#include <gmock/gmock.h>

#include "kiln/math/hash.h"
#include "kiln/pipeline/run.h"
#include "support/workshop.h"

namespace kiln {
namespace {

namespace fs = std::filesystem;

using test::narrow_limits;
using test::text_of;
using test::Workshop;
using testing::HasSubstr;

constexpr Size set_size{45, 150};

void paint_map(const Workshop& shop, const std::string& name,
               const std::vector<std::string>& channels) {
  Layers image = make_layers(set_size, channels);
  auto seed = static_cast<uint32_t>(name.size());
  for (Layer& layer : image.layers) {
    ++seed;
    for (int y = 0; y < set_size.height; ++y) {
      for (int x = 0; x < set_size.width; ++x) {
        const auto texel = static_cast<uint32_t>(y * set_size.width + x);
        layer.plane.at(x, y) = static_cast<float>(combine_hash(seed, texel) % 200 + 40) / 255.0f;
      }
    }
  }
  fs::create_directories(shop / "rock");
  write_image(shop / ("rock/" + name), image, {.type = PixelType::Uint8});
}

void paint_scene(const Workshop& shop) {
  shop.paint("sky.exr", 1.0f, PixelType::Float, {16, 8});
  paint_map(shop, "x_BaseColor.png", {"R", "G", "B"});
  paint_map(shop, "x_Roughness.png", {"Y"});
  paint_map(shop, "x_NormalGL.png", {"R", "G", "B"});
}

Plan plan_of(const Workshop& shop, const std::string& bakes, const std::string& out,
             const std::string& more = "") {
  const std::string text = "version: 1\n" + more +
                           "environment: { sky: sky.exr }\nsets: [{ path: rock }]\nbakes:\n" +
                           bakes;
  return make_plan(read_pipeline(shop.write("p.yaml", text)), shop / out);
}

std::string line(const std::string& settings) {
  return "  - { bake: preview, env: sky, samples: 16, " + settings + " }\n";
}

TEST(FlatPreviews, AreTheSameBytesForEveryMemoryBudgetInEveryFormat) {
  const Workshop shop;
  paint_scene(shop);
  std::string bakes;
  for (const char* file : {"a.exr", "a.png", "a.jpg", "a.tif", "a.hdr"}) {
    bakes += line(std::string("exposure: 1, out: ") + file);
  }
  for (const char* file : {"d.exr", "d.png", "d.jpg"}) {
    bakes += line(std::string("mode: difference, out: ") + file);
  }
  bakes += line("target_error: 0.001, out: t.exr") + line("mode: split-sum, out: s.exr");
  const Report wide = run_plan(plan_of(shop, bakes, "wide"), Records::None);
  const Report narrow = run_plan(plan_of(shop, bakes, "narrow", narrow_limits), Records::None);
  for (size_t i = 0; i < wide.tasks.size(); ++i) {
    const TaskRecord &a = wide.tasks[i], &b = narrow.tasks[i];
    ASSERT_FALSE(a.fault) << a.fault->what();
    ASSERT_FALSE(b.fault) << b.fault->what();
    EXPECT_FALSE(text_of(shop / "wide" / a.out).empty());
    EXPECT_EQ(text_of(shop / "wide" / a.out), text_of(shop / "narrow" / a.out)) << a.out;
    EXPECT_EQ(a.figures, b.figures);
    EXPECT_EQ(a.notes, b.notes);
  }
  const Size view = read_image(shop / "wide/d.png").facts.size;
  EXPECT_EQ(view.width, set_size.width);
  EXPECT_GT(view.height, set_size.height);
  EXPECT_EQ(wide.tasks.at(5).figures.at(1).first, "mean difference");
}

TEST(FlatPreviews, OfDifferencesAreRefusedWhereNoNumberMayBeNegative) {
  const Workshop shop;
  paint_scene(shop);
  const Report report =
      run_plan(plan_of(shop, line("mode: difference, out: d.hdr"), "out"), Records::None);
  EXPECT_THAT(report.tasks.at(0).fault->what(), HasSubstr("hdr holds no negative numbers"));
  EXPECT_FALSE(fs::exists(shop / "out/d.hdr"));
}

TEST(FlatPreviews, RefuseABudgetThatHoldsNoBand) {
  const Workshop shop;
  paint_scene(shop);
  const Report report = run_plan(
      plan_of(shop, line("out: a.exr"), "out", "limits: { memory: 1MiB }\n"), Records::None);
  EXPECT_THAT(report.tasks.at(0).fault->what(), HasSubstr("a band of 16 rows needs"));
  EXPECT_EQ(exit_code(report), 33);
}

TEST(FlatPreviews, KeepANumberATexelForAViewAndNothingElse) {
  const Workshop shop;
  paint_scene(shop);
  const auto bytes = [&](const char* settings) {
    const Plan plan = plan_of(shop, line(settings), "out");
    return predicted_memory(plan, plan.tasks.at(0)).value();
  };
  EXPECT_EQ(bytes("mode: difference, out: d.png") - bytes("mode: difference, out: d.exr"),
            4 * area(set_size));
}

}  // namespace
}  // namespace kiln

// SPDX-License-Identifier: Apache-2.0
#include "kiln/pipeline/run.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "support/workshop.h"

namespace kiln {
namespace {

using test::error_of;
using test::text_of;
using test::Workshop;
using testing::Contains;
using testing::HasSubstr;
using Status = TaskRecord::Status;

Plan plan_of(const Workshop& shop, const std::string& text, const std::string& out = "out") {
  return make_plan(read_pipeline(shop.write("rocks.yaml", "version: 1\n" + text)), shop / out);
}

const TaskRecord& task_of(const Report& report, const std::string& out) {
  for (const TaskRecord& task : report.tasks) {
    if (task.out == out) return task;
  }
  throw std::runtime_error("no task makes " + out);
}

void paint_sky(const Workshop& shop, const std::string& name = "sky.exr") {
  shop.paint(name, 1.0f, PixelType::Float, {16, 8});
}

// Any file that is not one of the named outputs or records would be a partial one.
std::vector<std::string> files_below(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) {
      names.push_back(entry.path().lexically_relative(folder).generic_string());
    }
  }
  std::sort(names.begin(), names.end());
  return names;
}

const char* const two_sets = R"(
environment: { sky: sky.exr }
sets: [{ glob: "tex/*/" }]
bakes:
  - { bake: lut, table: directional-albedo, size: 4, out: lut.exr }
  - { bake: preview, env: sky, samples: 4, out: "{set}/flat.exr" }
  - { bake: preview, env: sky, samples: 4, out: "{set}/flat.png" }
)";

TEST(Run, BakesEveryTaskAndKeepsRecords) {
  const Workshop shop;
  paint_sky(shop);
  shop.paint_set("tex/a");
  shop.paint_set("tex/b");
  const Report report = run_plan(plan_of(shop, two_sets), Records::Keep);
  for (const TaskRecord& task : report.tasks) {
    EXPECT_EQ(task.status, Status::Baked)
        << task.out << ": " << (task.fault ? task.fault->what() : "");
  }
  EXPECT_EQ(exit_code(report), 0);
  EXPECT_EQ(files_below(shop / "out"),
            (std::vector<std::string>{".kiln/report.json", ".kiln/times.json", "a/flat.exr",
                                      "a/flat.png", "b/flat.exr", "b/flat.png", "lut.exr"}));
}

TEST(Run, MakesTheSameBytesTwice) {
  const Workshop shop;
  paint_sky(shop);
  shop.paint_set("tex/a");
  run_plan(plan_of(shop, two_sets, "one"), Records::Keep);
  run_plan(plan_of(shop, two_sets, "two"), Records::Keep);
  for (const char* name : {"lut.exr", "a/flat.exr", "a/flat.png", ".kiln/report.json"}) {
    EXPECT_EQ(text_of(shop / "one" / name), text_of(shop / "two" / name)) << name;
    EXPECT_FALSE(text_of(shop / "one" / name).empty()) << name;
  }
}

TEST(Run, WritesViewingFormatsThroughTheDisplayAndOthersLinear) {
  const Workshop shop;
  paint_sky(shop);
  shop.paint_set("tex/a");
  run_plan(plan_of(shop, two_sets), Records::None);
  const ImageFile linear = read_image(shop / "out/a/flat.exr");
  const ImageFile shown = read_image(shop / "out/a/flat.png");
  EXPECT_EQ(linear.facts.type, PixelType::Half);
  EXPECT_EQ(shown.facts.type, PixelType::Uint8);
  EXPECT_NE(linear.image.find("stderr.R"), nullptr);
  const float value = linear.image.find("G")->at(1, 1);
  const float encoded = 1.055f * std::pow(value, 1 / 2.4f) - 0.055f;
  EXPECT_NEAR(shown.image.find("G")->at(1, 1), encoded, 1.5f / 255);
}

TEST(Run, WritesTablesAsRawNumbers) {
  const Workshop shop;
  run_plan(plan_of(shop,
                   "bakes:\n  - { bake: lut, size: 4, out: a.png }\n"
                   "  - { bake: lut, size: 4, out: a.exr }\n"),
           Records::None);
  const ImageFile png = read_image(shop / "out/a.png"), exr = read_image(shop / "out/a.exr");
  EXPECT_EQ(png.facts.type, PixelType::Uint16);
  EXPECT_EQ(exr.facts.type, PixelType::Float);
  EXPECT_NEAR(png.image.find("R")->at(2, 2), exr.image.find("R")->at(2, 2), 1e-5f);
}

TEST(Run, ReportsEveryMissingMapOfASetAtOnceAndFinishesTheRest) {
  const Workshop shop;
  paint_sky(shop);
  shop.paint_set("tex/a");
  const Report report = run_plan(plan_of(shop, R"(
environment: { sky: sky.exr }
sets:
  - { name: broken, maps: { base_color: no.png, roughness: gone.png } }
  - { path: tex/a }
bakes: [{ bake: preview, env: sky, samples: 4, out: "{set}/flat.exr" }]
)"),
                                 Records::Keep);
  const TaskRecord& broken = task_of(report, "broken/flat.exr");
  ASSERT_TRUE(broken.fault);
  EXPECT_EQ(broken.fault->fault(), Fault::Input);
  EXPECT_THAT(broken.fault->what(), HasSubstr("no.png (base_color)"));
  EXPECT_THAT(broken.fault->what(), HasSubstr("gone.png (roughness)"));
  EXPECT_EQ(task_of(report, "a/flat.exr").status, Status::Baked);
  EXPECT_EQ(exit_code(report), 1);
  EXPECT_FALSE(std::filesystem::exists(shop / "out/broken"));
}

TEST(Run, FailsOnlyTheTasksOfADamagedImage) {
  const Workshop shop;
  paint_sky(shop);
  for (const char* name : {"empty", "cut", "good"}) shop.paint_set(std::string("tex/") + name);
  shop.write("tex/empty/empty_BaseColor.png", "");
  const std::string whole = text_of(shop / "tex/cut/cut_BaseColor.png");
  shop.write("tex/cut/cut_BaseColor.png", whole.substr(0, whole.size() / 2));
  const Report report = run_plan(plan_of(shop, two_sets), Records::Keep);
  EXPECT_EQ(task_of(report, "good/flat.exr").status, Status::Baked);
  EXPECT_EQ(task_of(report, "lut.exr").status, Status::Baked);
  for (const char* name : {"empty", "cut"}) {
    const TaskRecord& task = task_of(report, std::string(name) + "/flat.exr");
    ASSERT_TRUE(task.fault) << name;
    EXPECT_EQ(task.fault->fault(), Fault::Input) << name;
    EXPECT_THAT(task.fault->what(), HasSubstr("_BaseColor.png")) << name;
  }
}

TEST(Run, GivesTheMessageOfABrokenEnvironmentToEveryTaskThatNeedsIt) {
  const Workshop shop;
  paint_sky(shop);
  shop.paint_set("tex/a");
  const Report report = run_plan(plan_of(shop, R"(
environment: { sky: sky.exr, gone: gone.exr }
sets: [{ path: tex/a }]
bakes:
  - { bake: preview, env: gone, samples: 4, out: "{set}/1.exr" }
  - { bake: preview, env: gone, samples: 4, shape: sphere, size: 8, out: "{set}/2.exr" }
  - { bake: preview, env: sky, samples: 4, out: "{set}/3.exr" }
)"),
                                 Records::None);
  for (const char* out : {"a/1.exr", "a/2.exr"}) {
    ASSERT_TRUE(task_of(report, out).fault);
    EXPECT_EQ(task_of(report, out).fault->fault(), Fault::Input);
    EXPECT_THAT(task_of(report, out).fault->what(), HasSubstr("gone.exr"));
  }
  EXPECT_EQ(task_of(report, "a/3.exr").status, Status::Baked);
}

TEST(Run, CountsAndReportsNanInAnEnvironment) {
  const Workshop shop;
  shop.paint_set("tex/a");
  Layers sky = make_layers({16, 8}, {"R", "G", "B"});
  for (Layer& layer : sky.layers) layer.plane = Plane(sky.size, 1.0f);
  sky.layers[0].plane.at(3, 3) = std::numeric_limits<float>::quiet_NaN();
  write_image(shop / "sky.exr", sky, {PixelType::Float, {}});
  const Report report = run_plan(plan_of(shop, two_sets), Records::None);
  EXPECT_EQ(task_of(report, "a/flat.exr").status, Status::Baked);
  ASSERT_EQ(report.environments.size(), 1u);
  EXPECT_THAT(report.environments[0].warnings, Contains(HasSubstr("NaN")));
}

TEST(Run, TellsWhichFileTookWhichSlotAndItsColorSpace) {
  const Workshop shop;
  paint_sky(shop);
  shop.paint_set("tex/a");
  const Report report = run_plan(plan_of(shop, two_sets), Records::None);
  ASSERT_EQ(report.sets.size(), 1u);
  const MapRecord& base = report.sets[0].maps.at(0);
  EXPECT_EQ(base.slot, "base_color");
  EXPECT_EQ(base.color, "srgb_rec709_scene -> lin_rec709_scene");
  EXPECT_EQ(report.sets[0].maps.at(1).color, "data");
}

TEST(Run, ScalesColoursInLinearLightAndConvertsConstantsThatNameTheirSpace) {
  const Workshop shop;
  shop.paint("c.png", 188 / 255.0f, PixelType::Uint8);  // half of white in linear light
  paint_sky(shop);
  run_plan(plan_of(shop, R"(
environment: { sky: sky.exr }
sets:
  - { name: a, maps: { base_color: { path: c.png, scale: 0.5 }, metallic: { value: 1 } } }
  - { name: b, maps: { base_color: { value: 0.5371, color_space: srgb_rec709_scene },
                       metallic: { value: 1 } } }
  - { name: c, maps: { base_color: { value: 0.25 }, metallic: { value: 1 } } }
material: { energy: none }
bakes: [{ bake: preview, env: sky, samples: 64, size: 1, type: float, out: "{set}.exr" }]
)"),
           Records::None);
  const float c = read_image(shop / "out/c.exr").image.find("R")->at(0, 0);
  EXPECT_NEAR(read_image(shop / "out/a.exr").image.find("R")->at(0, 0), c, 0.01f * c);
  EXPECT_NEAR(read_image(shop / "out/b.exr").image.find("R")->at(0, 0), c, 0.01f * c);
}

TEST(Run, RefusesAnOutputFolderBelowAFile) {
  const Workshop shop;
  shop.write("file", "x");
  const Plan plan = plan_of(shop, "bakes: [{ bake: lut, size: 4, out: a.exr }]\n", "file/out");
  EXPECT_EQ(error_of([&] { run_plan(plan, Records::Keep); }).fault(), Fault::Output);
}

TEST(Run, StopsBetweenTasksWhenInterrupted) {
  const Workshop shop;
  const Plan plan = plan_of(shop,
                            "bakes:\n  - { bake: lut, size: 4, out: a.exr }\n"
                            "  - { bake: lut, size: 4, out: b.exr }\n");
  int finished = 0;
  Watcher watcher;
  watcher.ended = [&](const TaskRecord&, const Progress&) { ++finished; };
  watcher.interrupted = [&] { return finished == 1 ? 15 : 0; };
  const Report report = run_plan(plan, Records::Keep, watcher);
  EXPECT_EQ(exit_code(report), 143);
  EXPECT_EQ(report.tasks.at(1).status, Status::NotRun);
  EXPECT_EQ(files_below(shop / "out"),
            (std::vector<std::string>{".kiln/report.json", ".kiln/times.json", "a.exr"}));
}

const char* const large_volume =
    "bakes: [{ bake: lut, table: ior, axes: \"f0,mu,roughness\", channels: scale, size: 4x600, "
    "depth: 120, out: a.dds }]\n";

TEST(Run, WritesAVolumeInBandsAndItsMetadataBeside) {
  const Workshop shop;
  const Report report = run_plan(plan_of(shop, large_volume), Records::None);
  EXPECT_EQ(report.tasks.at(0).status, Status::Baked);
  EXPECT_EQ(report.tasks.at(0).outputs, (std::vector<std::string>{"a.dds", "a.dds.json"}));
  EXPECT_EQ(read_image(shop / "out" / "a.dds").image.size, (Size{4, 72000}));
}

TEST(Run, StopsBetweenBandsWhenInterruptedAndLeavesNothing) {
  const Workshop shop;
  const Plan plan = plan_of(shop, large_volume);
  int asked = 0;
  Watcher watcher;
  watcher.interrupted = [&] { return ++asked > 2 ? 2 : 0; };
  const Report report = run_plan(plan, Records::None, watcher);
  EXPECT_EQ(exit_code(report), 130);
  EXPECT_EQ(report.tasks.at(0).status, Status::NotRun);
  EXPECT_TRUE(report.tasks.at(0).figures.empty());
  EXPECT_TRUE(files_below(shop / "out").empty());
}

TEST(Run, DoesNotOpenMapsThatNothingReads) {
  const Workshop shop;
  paint_sky(shop);
  shop.paint_set("tex/a");
  shop.write("tex/a/a_Emissive.png", "not an image");
  const Report report = run_plan(plan_of(shop, two_sets), Records::None);
  EXPECT_EQ(task_of(report, "a/flat.exr").status, Status::Baked);
}

}  // namespace
}  // namespace kiln

// SPDX-License-Identifier: Apache-2.0
#include "kiln/pipeline/plan.h"

#include <gmock/gmock.h>

#include "support/workshop.h"

namespace kiln {
namespace {

using test::error_of;
using test::message_of;
using test::Workshop;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

Plan plan_of(const Workshop& shop, const std::string& text) {
  return make_plan(read_pipeline(shop.write("rocks.yaml", "version: 1\n" + text)), shop / "out");
}

std::string refusal_of(const Workshop& shop, const std::string& text) {
  const Error error = error_of([&] { plan_of(shop, text); });
  EXPECT_EQ(error.fault(), Fault::Usage);
  return error.what();
}

std::vector<std::string> outputs_of(const Plan& plan) {
  std::vector<std::string> outputs;
  for (const Task& task : plan.tasks) outputs.push_back(task.out);
  return outputs;
}

TEST(Plan, RunsOnceTasksFirstThenSetBySet) {
  const Workshop shop;
  shop.paint_set("tex/b");
  shop.paint_set("tex/a");
  const Plan plan = plan_of(shop, R"(
environment: { sky: sky.exr }
sets: [{ glob: "tex/*/" }]
bakes:
  - { bake: preview, env: sky, out: "{set}/flat.exr" }
  - { bake: lut, out: lut.exr }
  - { bake: preview, env: sky, shape: sphere, out: "{set}/ball.png" }
)");
  EXPECT_THAT(outputs_of(plan),
              ElementsAre("lut.exr", "a/flat.exr", "a/ball.png", "b/flat.exr", "b/ball.png"));
}

TEST(Plan, RefusesAPatternThatMatchesNothing) {
  const Workshop shop;
  EXPECT_THAT(
      refusal_of(shop, "sets: [{ glob: \"none*/\" }]\nbakes: []\n"),
      AllOf(HasSubstr("rocks.yaml:2:8: "), HasSubstr("no folder matches"), HasSubstr("none*")));
}

TEST(Plan, SkipsAGlobbedFolderWithoutKnownMapsAndSaysSo) {
  const Workshop shop;
  shop.paint_set("tex/a");
  shop.write("tex/notes/readme.txt", "x");
  const Plan plan = plan_of(shop, "sets: [{ glob: \"tex/*/\" }]\nbakes: []\n");
  EXPECT_EQ(plan.sets.size(), 1u);
  EXPECT_THAT(plan.warnings, ElementsAre(HasSubstr("notes: skipped")));
}

TEST(Plan, FailsTheTasksOfAFolderThatIsNamedDirectlyAndOfNoUse) {
  const Workshop shop;
  shop.write("empty/readme.txt", "x");
  const Plan plan = plan_of(shop, "sets: [{ path: empty }, { path: missing }]\nbakes: []\n");
  ASSERT_EQ(plan.sets.size(), 2u);
  EXPECT_EQ(plan.sets[0].fault->fault(), Fault::Input);
  EXPECT_THAT(plan.sets[1].fault->what(), HasSubstr("no such folder"));
}

TEST(Plan, RefusesTwoTasksWithOneOutput) {
  const Workshop shop;
  EXPECT_THAT(
      refusal_of(shop,
                 "bakes:\n  - { bake: lut, out: a/x.exr }\n  - { bake: lut, out: a/./x.exr }\n"),
      AllOf(HasSubstr("two tasks have one output"), HasSubstr("'a/x.exr'")));
}

TEST(Plan, RefusesAnOutputInsideTheFolderOfAnother) {
  const Workshop shop;
  EXPECT_THAT(refusal_of(shop,
                         "environment: { sky: s.exr }\nbakes:\n"
                         "  - { bake: environment, env: sky, out: env }\n"
                         "  - { bake: lut, out: env/x.exr }\n  - { bake: lut, out: env-b.exr }\n"),
              HasSubstr("write 'env' and, inside it, 'env/x.exr'"));
}

TEST(Plan, RefusesOutputsThatLeaveTheOutputFolder) {
  const Workshop shop;
  for (const char* out : {"../x.exr", "a/../../x.exr", "/tmp/x.exr"}) {
    EXPECT_THAT(refusal_of(shop, std::string("bakes: [{ bake: lut, out: ") + out + " }]\n"),
                HasSubstr("leaves the output folder"))
        << out;
  }
  EXPECT_THAT(refusal_of(shop, "bakes: [{ bake: lut, out: .kiln/report.json }]\n"),
              HasSubstr("where records are kept"));
}

TEST(Plan, WantsTheSetInTheOutputOfABakeThatRunsPerSet) {
  const Workshop shop;
  shop.paint_set("tex/a");
  shop.paint_set("tex/b");
  EXPECT_THAT(refusal_of(shop,
                         "environment: { sky: s.exr }\nsets: [{ glob: \"tex/*/\" }]\n"
                         "bakes: [{ bake: preview, env: sky, out: flat.exr }]\n"),
              HasSubstr("expected '{set}' in it"));
}

TEST(Plan, RefusesModelsThatDoNotFitOrCannotBeBaked) {
  const Workshop shop;
  shop.paint_set("tex/a");
  const std::string lit = "environment: { sky: s.exr }\nsets: [{ path: tex/a }]\n";
  EXPECT_THAT(refusal_of(shop, lit + "material: { distribution: charlie }\n"
                                     "bakes: [{ bake: preview, env: sky, out: a.exr }]\n"),
              HasSubstr("masking 'smith-correlated' does not fit distribution 'charlie'"));
  EXPECT_THAT(refusal_of(shop, lit + "material: { fresnel: schlik }\n"
                                     "bakes: [{ bake: preview, env: sky, out: a.exr }]\n"),
              HasSubstr("did you mean 'schlick'?"));
  EXPECT_THAT(refusal_of(shop, lit + "material: { bsdf: glass }\n"
                                     "bakes: [{ bake: preview, env: sky, mode: split-sum, "
                                     "out: a.exr }]\n"),
              HasSubstr("glass is rendered in mode reference only"));
}

TEST(Plan, LetsLightsStandInForAnEnvironment) {
  const Workshop shop;
  shop.paint_set("tex/a");
  const std::string sets = "sets: [{ path: tex/a }]\n";
  const Plan plan = plan_of(shop, sets +
                                      "bakes:\n  - bake: preview\n    out: a.exr\n    lights:\n"
                                      "      - dir:0,0,1:1,1,1\n      - dir:1,0,1:2,2,2\n");
  ASSERT_EQ(plan.tasks.size(), 1u);
  EXPECT_FALSE(plan.tasks[0].needs.light);
  EXPECT_THAT(refusal_of(shop, sets + "bakes: [{ bake: preview, out: a.exr }]\n"),
              HasSubstr("expected 'env', 'lights' or both"));
  EXPECT_THAT(refusal_of(shop, sets + "bakes: [{ bake: preview, lights: \"dir:0,0,1\", "
                                      "out: a.exr }]\n"),
              HasSubstr("light: found 'dir:0,0,1', expected dir:x,y,z:r,g,b"));
  EXPECT_THAT(refusal_of(shop, "bakes: [{ bake: environment, out: a }]\n"),
              HasSubstr("key 'env' is missing"));
}

TEST(Plan, RefusesFormatsAndTypesItCannotWrite) {
  const Workshop shop;
  EXPECT_THAT(refusal_of(shop, "bakes: [{ bake: lut, out: a.exrr }]\n"),
              HasSubstr("unknown file extension '.exrr' (did you mean '.exr'?)"));
  EXPECT_THAT(refusal_of(shop, "bakes: [{ bake: lut, out: a.png, type: half }]\n"),
              HasSubstr("png does not hold half, expected uint8 or rgbd8 or uint16"));
  EXPECT_THAT(refusal_of(shop, "bakes: [{ bake: lut, out: folder }]\n"),
              HasSubstr("expected a file name with an extension"));
  EXPECT_THAT(refusal_of(shop, "bakes: [{ bake: lut, out: a.jpg }]\n"),
              HasSubstr("jpg loses numbers"));
}

TEST(Plan, NamesTheNearestEnvironmentTableAndColorSpace) {
  const Workshop shop;
  EXPECT_THAT(refusal_of(shop,
                         "environment: { studio: s.exr }\n"
                         "bakes: [{ bake: environment, env: studo, out: e }]\n"),
              HasSubstr("rocks.yaml:3:35: unknown environment 'studo' (did you mean 'studio'?)"));
  EXPECT_THAT(refusal_of(shop, "bakes: [{ bake: lut, table: split-sun, out: a.exr }]\n"),
              HasSubstr("(did you mean 'split-sum'?)"));
  EXPECT_THAT(refusal_of(shop, "color: { working: lin_rec709_scne }\nbakes: []\n"),
              HasSubstr("(did you mean 'lin_rec709_scene'?)"));
}

TEST(Plan, RefusesTwoSetsOfOneName) {
  const Workshop shop;
  shop.paint_set("one/a");
  shop.paint_set("two/a");
  EXPECT_THAT(refusal_of(shop, "sets: [{ glob: \"*/a\" }]\nbakes: []\n"),
              HasSubstr("two texture sets are named 'a'"));
}

TEST(Plan, TakesTheWorkflowOfTheSetOverThatOfTheMaterial) {
  const Workshop shop;
  const Plan plan = plan_of(shop, R"(
sets:
  - { name: a, maps: { diffuse: d.png, roughness: r.png }, workflow: albedo-specular-roughness }
  - { name: b, maps: { base_color: d.png } }
material: { workflow: metal-rough }
bakes: []
)");
  EXPECT_EQ(plan.sets.at(0).reading.workflow, Workflow::AlbedoSpecularRoughness);
  EXPECT_EQ(plan.sets.at(1).reading.workflow, Workflow::MetalRough);
}

TEST(Plan, TakesMaterialFilesByNameOrPatternAndABrokenOneCostsNoOther) {
  const Workshop shop;
  shop.write("m/a/material.yaml",
             "name: a\nworkflow: spec-gloss\nalpha_cutoff: 0.3\nmaps: { diffuse: d.png }\n"
             "material: { diffuse: lambert }\n");
  shop.write("m/b/material.yaml", "maps: { base_colour: c.png }\n");
  const Plan plan = plan_of(shop,
                            "sets: [{ glob: \"m/*/material.yaml\" },\n"
                            "       { path: m/a/material.yaml, name: again }]\nbakes: []\n");
  ASSERT_EQ(plan.sets.size(), 3u);
  const PlannedSet& set = plan.sets[0];
  EXPECT_EQ(set.name, "a");
  EXPECT_EQ(set.reading.workflow, Workflow::SpecGloss);
  EXPECT_EQ(set.alpha_cutoff, 0.3);
  EXPECT_EQ(set.maps.at(0).path, shop / "m/a/d.png");
  EXPECT_THAT(set.warnings.at(0), HasSubstr("diffuse not read here"));
  ASSERT_TRUE(plan.sets[1].fault);
  EXPECT_THAT(plan.sets[1].fault->what(), HasSubstr("did you mean 'base_color'?"));
  EXPECT_EQ(plan.sets[2].name, "again");
  EXPECT_THAT(refusal_of(shop, "sets: [{ path: a.yaml, wrap: clamp }]\nbakes: []\n"),
              HasSubstr("wrap: a material file says itself how it is read"));
  EXPECT_THAT(refusal_of(shop, "sets: [{ glob: \"m/*/no.yaml\" }]\nbakes: []\n"),
              HasSubstr("no file matches"));
}

TEST(PlanSelection, MatchesSetsAndOutputs) {
  const Workshop shop;
  shop.paint_set("tex/a");
  shop.paint_set("tex/b");
  const Plan plan = plan_of(shop,
                            "environment: { sky: s.exr }\nsets: [{ glob: \"tex/*/\" }]\nbakes:\n"
                            "  - { bake: lut, out: lut/dfg.exr }\n"
                            "  - { bake: preview, env: sky, out: \"{set}/flat.exr\" }\n");
  EXPECT_THAT(outputs_of(only(plan, {"b"})), ElementsAre("b/flat.exr"));
  EXPECT_THAT(outputs_of(only(plan, {"lut/*", "a"})), ElementsAre("lut/dfg.exr", "a/flat.exr"));
  EXPECT_EQ(only(plan, {}).tasks.size(), 3u);
  EXPECT_THAT(message_of([&] { only(plan, {"c?"}); }),
              HasSubstr("--only: unknown set or output 'c?'"));
}

}  // namespace
}  // namespace kiln

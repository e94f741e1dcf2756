// SPDX-License-Identifier: Apache-2.0
#include "kiln/core/param.h"

#include <gtest/gtest.h>

namespace kiln {
namespace {

enum class Shape { Flat, Ball };

struct Settings {
  int samples = 64;
  double exposure = 0;
  Shape shape = Shape::Flat;
  Size size{0, 0};
  bool exact = false;
};

Params<Settings> params() {
  return {integer_param("samples", &Settings::samples, {1, 100}, "how many"),
          number_param("exposure", &Settings::exposure, {-10, 10}, "[EV]", "brighter"),
          word_param("shape", &Settings::shape, {"flat", "ball"}, "what"),
          extent_param("size", &Settings::size, {1, 4096}, "how large"),
          flag_param("exact", &Settings::exact, "or not")};
}

std::string refusal(const std::string& name, const std::string& text) {
  Settings settings;
  try {
    assign(params(), settings, name, text);
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::Usage);
    return error.what();
  }
  return "accepted";
}

TEST(Params, AreAssignedFromTextByTheirType) {
  Settings settings;
  assign(params(), settings, "samples", "12");
  assign(params(), settings, "exposure", "-1.5");
  assign(params(), settings, "shape", "Ball");
  assign(params(), settings, "size", "640x480");
  assign(params(), settings, "exact", "yes");
  EXPECT_EQ(settings.samples, 12);
  EXPECT_EQ(settings.exposure, -1.5);
  EXPECT_EQ(settings.shape, Shape::Ball);
  EXPECT_EQ(settings.size, (Size{640, 480}));
  EXPECT_TRUE(settings.exact);
}

TEST(Params, OneNumberIsASquareExtent) {
  Settings settings;
  assign(params(), settings, "size", "256");
  EXPECT_EQ(settings.size, (Size{256, 256}));
}

TEST(Params, TakeTheirDefaultsFromTheSettings) {
  const auto facts = facts_of(params());
  EXPECT_EQ(facts[0].default_text, "64");
  EXPECT_EQ(facts[2].default_text, "flat");
  EXPECT_EQ(facts[3].default_text, "input");
}

TEST(Params, RefuseWhatIsOutOfRangeOrNotOfTheirType) {
  EXPECT_EQ(refusal("samples", "0"), "samples: found '0', expected a whole number from 1 to 100");
  EXPECT_EQ(refusal("samples", "12.5"),
            "samples: found '12.5', expected a whole number from 1 to 100");
  EXPECT_EQ(refusal("exposure", "bright"),
            "exposure: found 'bright', expected a number from -10 to 10");
  EXPECT_EQ(refusal("exposure", "nan"), "exposure: found 'nan', expected a number from -10 to 10");
  EXPECT_EQ(refusal("shape", "bal"), "unknown shape 'bal' (did you mean 'ball'?)");
  EXPECT_EQ(refusal("size", "12x"),
            "size: found '', expected a size N or WxH, each from 1 to 4096");
}

TEST(Params, RefuseAnUnknownNameWithTheNearest) {
  EXPECT_EQ(refusal("sampels", "3"), "unknown parameter 'sampels' (did you mean 'samples'?)");
}

}  // namespace
}  // namespace kiln

// SPDX-License-Identifier: Apache-2.0
#include "lettering.h"

#include <gtest/gtest.h>

#include <set>

#include "sheet.h"

namespace kiln {
namespace {

double ink_of(std::string_view text, double height, Size size = {400, 40}) {
  Layers sheet = make_sheet(size, {0, 0, 0});
  draw_text(sheet, {10, 28}, text, {height, {1, 1, 1}});
  double sum = 0;
  for (int y = 0; y < size.height; ++y) {
    for (const float value : sheet.layers[0].plane.texels_of_row(y)) sum += value;
  }
  return sum;
}

TEST(Lettering, HasItsOwnShapeForEveryLetterOfAscii) {
  std::set<std::string_view> shapes;
  for (char letter = ' ' + 1; letter < 127; ++letter) {
    const std::string_view strokes = strokes_of(letter);
    EXPECT_TRUE(shapes.insert(strokes).second) << letter;
    EXPECT_GT(ink_of(std::string(1, letter), 18), 5) << letter;
    for (const char c : strokes) EXPECT_TRUE(c == ' ' || (c >= '0' && c <= '8')) << letter;
  }
  EXPECT_EQ(ink_of(" ", 18), 0);
}

TEST(Lettering, DrawsOneBoxForALetterItDoesNotKnow) {
  EXPECT_EQ(ink_of("\u00e9", 18), ink_of("\x01", 18));
  EXPECT_EQ(text_width("\u00e9\u4e2d", 18), text_width("\x01\x02", 18));
}

TEST(Lettering, IsAsWideAsItSays) {
  const std::string text = "Rock020 1K";
  const double height = 18, width = text_width(text, height);
  Layers sheet = make_sheet({400, 40}, {0, 0, 0});
  draw_text(sheet, {10, 28}, text, {height, {1, 1, 1}});
  int first = 400, last = 0;
  for (int y = 0; y < 40; ++y) {
    for (int x = 0; x < 400; ++x) {
      if (sheet.layers[0].plane.at(x, y) < 0.5f) continue;
      first = std::min(first, x);
      last = std::max(last, x);
    }
  }
  EXPECT_NEAR(first, 10, 2);
  EXPECT_NEAR(last, 10 + width, 2);
  EXPECT_EQ(text_within(text, height, width), text);
  const std::string shorter = text_within(text, height, 0.7 * width);
  EXPECT_TRUE(shorter.ends_with("..."));
  EXPECT_LE(text_width(shorter, height), 0.7 * width);
}

TEST(Lettering, StaysInsideTheImage) {
  EXPECT_GE(ink_of("far outside on the right", 30, {20, 12}), 0);
}

TEST(Sheet, LaysPicturesOverByTheirAlpha) {
  Layers sheet = make_sheet({4, 2}, {0.5f, 0.5f, 0.5f});
  Layers picture = make_layers({2, 2}, {"R", "G", "B", "A"});
  picture.layers[0].plane = Plane({2, 2}, 1.0f);
  picture.layers[3].plane = Plane({2, 2}, 0.25f);
  place(picture, {3, 1}, sheet);
  EXPECT_FLOAT_EQ(sheet.layers[0].plane.at(3, 1), 0.625f);
  EXPECT_FLOAT_EQ(sheet.layers[1].plane.at(3, 1), 0.375f);
  EXPECT_FLOAT_EQ(sheet.layers[0].plane.at(2, 1), 0.5f);
  EXPECT_FLOAT_EQ(sheet.layers[3].plane.at(3, 1), 1.0f);
}

TEST(Sheet, TurnsDisplayCodesToLightAndBack) {
  for (int code = 0; code < 256; ++code) {
    const auto value = static_cast<float>(code) / 255;
    EXPECT_NEAR(to_srgb(from_srgb(value)), value, 1e-6);
  }
}

}  // namespace
}  // namespace kiln

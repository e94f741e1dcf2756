// SPDX-License-Identifier: Apache-2.0
// Every table of every preset: what is baked is recognised from its numbers alone.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "kiln/bake/bake.h"
#include "kiln/bake/lut.h"
#include "kiln/validate/verify.h"

namespace kiln {
namespace {

using Stored = NumberArray::Stored;

struct PresetTable {
  std::string preset, type, table;
};

// Facts of a preset are its tables, its type and notes.
std::vector<PresetTable> preset_tables() {
  std::vector<PresetTable> all;
  for (const NamedText& preset : list_lut_presets()) {
    std::string type;
    for (const auto& [name, text] : preset.facts) {
      if (name == "type") type = text;
    }
    for (const auto& [name, text] : preset.facts) {
      if (name != "type" && name != "note") all.push_back({preset.name, type, name});
    }
  }
  return all;
}

Stored stored_of(const std::string& type) {
  if (type == "uint8" || type == "rgbd8") return Stored::Uint8;
  if (type == "uint16") return Stored::Uint16;
  if (type == "half") return Stored::Half;
  return type == "rgb10a2" ? Stored::Rgb10a2 : Stored::Float;
}

double rounded(double value, double steps) {
  return std::round(std::clamp(value, 0.0, 1.0) * steps) / steps;
}

// Eleven bits of precision; smaller numbers than 2^-14 are further apart.
double rounded_to_half(double value) {
  int exponent = 0;
  std::frexp(value, &exponent);
  const double step = std::exp2(std::max(exponent, -13) - 11);
  return std::round(value / step) * step;
}

double quantised(double value, Stored stored) {
  switch (stored) {
    case Stored::Uint8:
      return rounded(value, 255);
    case Stored::Uint16:
      return rounded(value, 65535);
    case Stored::Rgb10a2:
      return rounded(value, 1023);
    case Stored::Half:
      return rounded_to_half(value);
    default:
      return value;
  }
}

// Colour over a divisor in alpha that lets it reach above 1, under the power 1 / 2.2.
std::vector<double> rgbd(const std::vector<double>& color) {
  const double greatest = std::max({color[0], color[1], color[2], 1e-6});
  const double divisor = std::max(rounded(std::min(1 / greatest, 1.0), 255), 1.0 / 255);
  std::vector<double> entry;
  for (const double value : color) entry.push_back(std::pow(value * divisor, 1 / 2.2));
  entry.push_back(divisor);
  return entry;
}

// The artifact as numbers that say nothing of themselves.
NumberArray numbers_of(const Artifact& artifact, const std::string& type) {
  const Layers& image = artifact.image;
  NumberArray array;
  array.stored = stored_of(type);
  int channels = 0;
  for (int y = 0; y < image.size.height; ++y) {
    for (int x = 0; x < image.size.width; ++x) {
      std::vector<double> entry;
      for (const Layer& layer : image.layers) entry.push_back(layer.plane.at(x, y));
      if (type == "rgbd8") entry = rgbd(entry);
      channels = static_cast<int>(entry.size());
      for (const double value : entry) array.values.push_back(quantised(value, array.stored));
    }
  }
  array.shape = {image.size.height / artifact.depth, image.size.width, channels};
  if (artifact.depth > 1) array.shape.insert(array.shape.begin(), artifact.depth);
  return array;
}

Artifact bake(const PresetTable& wanted) {
  const auto recipe = make_recipe("lut");
  recipe->set("table", wanted.table);
  recipe->set("preset", wanted.preset);
  const bool solid = wanted.table == "glass";
  recipe->set("size", wanted.table == "average-albedo" ? "24" : solid ? "8x8" : "24x24");
  recipe->set("depth", "8");
  return recipe->bake({}).artifacts.at(0);
}

std::string summary(const Verdict& verdict) {
  std::string text = verdict.best.table_class + ": " + verdict.best.convention + " | max " +
                     std::to_string(verdict.best.max_error) + " rms " +
                     std::to_string(verdict.best.rms_error) + " ratio " +
                     std::to_string(verdict.ratio);
  for (const std::string& statement : verdict.statements) text += "\n  " + statement;
  return text;
}

TEST(EveryLutPreset, IsRecognisedFromItsNumbersAlone) {
  for (const PresetTable& one : preset_tables()) {
    SCOPED_TRACE(one.preset + " " + one.table);
    const Verdict verdict = verify_tables({numbers_of(bake(one), one.type)});
    EXPECT_TRUE(verdict.fits) << summary(verdict);
    // Filament's cloth is a channel of a split sum, whichever table it is asked of.
    const std::string expected = one.preset == "filament-cloth" ? "split-sum" : one.table;
    EXPECT_EQ(verdict.best.table_class, expected) << summary(verdict);
    EXPECT_THAT(verdict.presets, testing::Contains(one.preset)) << summary(verdict);
  }
}

}  // namespace
}  // namespace kiln

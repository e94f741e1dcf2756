// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "kiln/bake/named_text.h"

namespace kiln {

/// Parameters of the bake `lut` as a user writes them: table, preset, axes, ...
using LutWords = std::vector<std::pair<std::string, std::string>>;

struct PointValue {
  std::string channel;
  double value = 0;
};

/// The channels of a table at one point, to about 1e-11.
/// @param point  one coordinate for each axis of the table, in their order
/// @error Fault::Usage for unknown words or a point outside the domain
std::vector<PointValue> integrate_at(const LutWords& words, const std::vector<double>& point);

/// The quantities of a table's axes, in their order: "mu", "roughness".
std::vector<std::string> lut_axes(const LutWords& words);

/// Code that looks up exactly this table, with five points to check it by.
/// @param language  "glsl", "hlsl" or "cpp"
/// @param file      name of the table's file, for the comment
/// @param rgbd      stored as RGBD
std::string lut_snippet(const LutWords& words, const std::string& language, const std::string& file,
                        bool rgbd);

std::vector<NamedText> list_tables();
std::vector<NamedText> list_lut_axes();
std::vector<NamedText> list_lut_channels();
std::vector<NamedText> list_lut_presets();

}  // namespace kiln

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "kiln/bake/named_text.h"
#include "kiln/material/normals.h"
#include "kiln/material/slots.h"

namespace kiln {

/// What one channel of a packed file holds: a map's channel, one minus it, or a constant.
struct PackSource {
  Slot slot = Slot::Roughness;
  int channel = 0;
  bool inverted = false;
  bool is_constant = false;
  float constant = 0;
  NormalConvention convention = NormalConvention::OpenGl;  ///< of a normal
  std::string text;                                        ///< as it was written
};

/// A packed file: its name and one source for each channel, R G B A or one alone.
struct PackedFile {
  std::string suffix;
  std::vector<PackSource> channels;
};

/// "ambient_occlusion, roughness, metallic", as it was written.
std::string sources_text(const PackedFile& file);

/// Files and channels as an engine wants them, in words:
///
///     "orm = ambient_occlusion, roughness, metallic; normal = normal"
///
/// A source is a map (of three channels: `base_color.r`; alone it stands for all three),
/// `smoothness`, `1 - source`, or a number. `normal` and `normal_gl` point up, `normal_dx` down.
/// @error Fault::Usage naming what is not understood, and the nearest word
std::vector<PackedFile> parse_layout(const std::string& text);

/// How an engine wants the maps of a set: data, no code. A new one is one entry on the list.
struct PackPreset {
  std::string name;
  std::string summary;
  std::string layout;  ///< as parse_layout reads it
};
const std::vector<PackPreset>& all_pack_presets();
std::vector<std::string> pack_preset_names();
/// @error Fault::Usage, naming the nearest known one
const PackPreset& find_pack_preset(const std::string& name);

/// The presets with their files, for lists.
std::vector<NamedText> list_pack_presets();

}  // namespace kiln

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "kiln/image/plane.h"
#include "noise.h"

namespace kiln::textures {

/// What a material is at one point of its tile.
struct Spot {
  Color color;         ///< base colour, or albedo, linear [0..1]
  Color specular;      ///< reflectance at normal incidence; where the set has a specular colour
  double level = 0.5;  ///< specular level of a dielectric: F0 = 0.08 level; where the set has one
  double roughness = 0.5;  ///< perceptual [0..1]
  double metallic = 0;     ///< [0..1]
  double height = 0.5;     ///< [0..1] of the relief
};

/// What a file of a set holds. Colours are sRGB encoded, everything else is stored as it is.
enum class Map {
  Albedo,
  SpecularColor,
  SpecularLevel,
  Roughness,
  Glossiness,
  Metallic,
  Occlusion,
  OcclusionRoughnessMetallic,
  NormalOpenGl,
  NormalDirectX,
  Height
};

struct MapFile {
  std::string name;  ///< with extension
  Map map;
};

/// A texture set: a material, how deep its relief is, and the files it is told in.
struct Set {
  std::string folder;
  std::function<Spot(Point)> spot;  ///< over the tile [0,1)^2, v down; repeats without a seam
  double relief = 4;                ///< height 1 above height 0 [texel of a 512 texel tile]
  std::vector<MapFile> files;
};

inline constexpr int tile_size = 512;  ///< edge of every map [texel]

/// Paints every map of a set and writes it below `folder / set.folder`.
void write_set(const Set& set, const std::filesystem::path& folder);

Set brushed_steel();
Set glazed_tiles();
Set rusted_iron();
Set woven_fabric();
Set painted_panel();

}  // namespace kiln::textures

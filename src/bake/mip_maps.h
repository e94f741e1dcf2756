// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "kiln/bake/mip_sheet.h"
#include "kiln/material/map_bands.h"
#include "kiln/material/normal_filter.h"

namespace kiln {

/// Rows of a set that are about to be filtered.
struct MipBand {
  int first = 0, rows = 0;
  SlotMaps stored;              ///< images only, finite
  SlotMaps linear;              ///< colours in the working space
  Plane roughness;              ///< perceptual, where lobes are asked for
  std::array<Plane, 3> normal;  ///< decoded, likewise and for normals
};

/// How the levels of one file follow from averages: which numbers of a texel are averaged, and what
/// is stored of them. Averages are linear, so that every level is an average of the first.
struct MipMap {
  MipFile file;
  int channels = 1;  ///< numbers averaged
  /// The numbers of row y of a band. Rows are padded to whole vectors.
  std::function<void(const MipBand& band, int y, float* const* numbers)> fill;
  /// Averages to what the layers of the file hold.
  std::function<void(int level, int width, const float* const* numbers, float* const* layers)>
      store;
  /// The first level, as the map is.
  std::function<Layers(const MipBand& band)> first;
  bool first_as_stored = false;  ///< it is in color_stored
  /// Sum over a row of what an average is to keep, so that the means of levels can be compared.
  /// Empty: there is no such thing.
  std::function<double(int width, const float* const* numbers, const float* const* layers)> energy;
  std::string energy_name;         ///< "alpha^2"
  bool energy_of_numbers = false;  ///< else of layers, and numbers may be null
};

/// What the maps of one sheet have in common.
struct MipChoice {
  NormalFiltering normals;
  std::optional<NormalForm> form;     ///< of the normal map, where there is one
  bool weighted = false;              ///< colours by opacity
  bool opacity_within = false;        ///< which stands in the file of the colours, as alpha
  std::vector<float> opacity_scales;  ///< [levels], which keep its coverage
};

MipMap color_mips(const GivenMap& map, const MapBands& bands, const MipChoice& choice);
MipMap number_mips(const GivenMap& map);
/// Angles of anisotropy, in turns.
MipMap angle_mips(const GivenMap& map);
MipMap opacity_mips(const GivenMap& map, const MipChoice& choice);
MipMap normal_mips(const GivenMap& map, const MipChoice& choice);
/// @param gloss  stored is 1 - roughness
MipMap roughness_mips(const std::string& name, bool gloss, const std::string& type,
                      const MipChoice& choice);
/// Layers alpha_x, alpha_y, angle.
MipMap anisotropy_mips(const std::string& type, const MipChoice& choice);

/// Factors for each level that keep the share of texels whose opacity exceeds the threshold.
std::vector<float> coverage_scales(Plane opacity, int levels, double threshold);

}  // namespace kiln

// SPDX-License-Identifier: Apache-2.0
#include "normal_reading.h"

#include <algorithm>

#include "file_windows.h"
#include "map_opening.h"

namespace kiln {
namespace {

// The height map that tells the convention, where nothing else does.
const PlannedMap* height_for(const PlannedSet& set, const PlannedMap& normal) {
  const bool is_open =
      normal.convention == NormalConvention::Auto && set.reading.normal == NormalConvention::Auto;
  if (!is_open) return nullptr;
  const auto found = std::find_if(set.maps.begin(), set.maps.end(), [](const PlannedMap& map) {
    return map.slot == Slot::Height && !map.path.empty();
  });
  return found == set.maps.end() ? nullptr : &*found;
}

Plane height_rows(const PlannedMap& map, FileWindows& file, Size size, RowRange rows) {
  const MapRows::Window window = file.next(size.height, rows);
  const Layers picked = pick_slot(window.image, Slot::Height, map.channels);
  return resample_rows(picked.layers[0].plane, window.first, file.facts().size.height, size, rows);
}

}  // namespace

NormalForm normal_form(const PlannedSet& set, const PlannedMap& normal) {
  ImageRows normals = rows_of(normal);
  const Size size = normals.facts().size;
  const PixelType type = normals.facts().type;
  const PlannedMap* height = height_for(set, normal);
  std::optional<FileWindows> heights;
  if (height) heights.emplace(rows_of(*height));
  NormalSurvey survey(head_of(normal), set.reading, height != nullptr,
                      type == PixelType::Half || type == PixelType::Float);
  const int band = static_cast<int>(
      std::clamp<long long>(NormalSurvey::enough_texels / size.width, 1, size.height));
  for (int first = 0; first < size.height; first += band) {
    const RowRange rows{first, std::min(band, size.height - first)};
    const Layers picked = pick_slot(normals.next(rows.count), Slot::Normal, normal.channels);
    if (height) {
      const Plane beside = height_rows(*height, *heights, size, rows);
      survey.add(picked, &beside);
    } else {
      survey.add(picked, nullptr);
    }
    if (!survey.is_open()) break;
  }
  return survey.form();
}

}  // namespace kiln

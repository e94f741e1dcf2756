// SPDX-License-Identifier: Apache-2.0
#include "stored_rows.h"

#include "map_files.h"

namespace kiln {
namespace {

bool is_width(Slot slot) { return slot == Slot::Roughness || slot == Slot::Gloss; }

}  // namespace

Slot stand_in(Slot slot) {
  switch (slot) {
    case Slot::Roughness:
      return Slot::Gloss;
    case Slot::Gloss:
      return Slot::Roughness;
    case Slot::BaseColor:
      return Slot::Diffuse;
    case Slot::Diffuse:
      return Slot::BaseColor;
    default:
      return slot;
  }
}

const GivenMap* standing_for(const MapBands& maps, Slot slot) {
  const GivenMap* map = maps.find(slot);
  return map != nullptr ? map : maps.find(stand_in(slot));
}

Plane stored_channel(const SlotMaps& rows, const GivenMap* map, Slot slot, int channel, Size size) {
  const auto c = static_cast<size_t>(channel);
  if (map == nullptr) return {size, slot_facts(slot).missing[c]};
  const SlotMap& stored = rows.at(map->slot);
  Plane plane;
  if (stored.value) {
    plane = Plane(size, (*stored.value)[c]);
  } else {
    const auto& layers = stored.image.layers;
    plane = layers[layers.size() < 3 ? 0 : c].plane;
  }
  if (is_width(slot) && map->slot != slot) invert(plane);
  return plane;
}

Layers stored_normals(const SlotMap& rows, const NormalForm& form, NormalConvention convention) {
  const bool turned = form.decoding.convention != convention;
  const bool as_stored = form.decoding.layout == NormalLayout::ThreeChannel &&
                         form.decoding.range == NormalRange::Unsigned;
  if (as_stored) {
    Layers normals = rows.image;
    if (turned) invert(normals.layers[1].plane);
    return normals;
  }
  return encoded_normals(decode_normals(rows.image, form.decoding).normal, convention);
}

Layers encoded_normals(std::array<Plane, 3> normal, NormalConvention convention) {
  if (convention == NormalConvention::DirectX) flip_y(normal);
  for (Plane& plane : normal) {
    for (int y = 0; y < plane.height(); ++y) {
      float* row = plane.row(y);
      for (int x = 0; x < plane.width(); ++x) row[x] = 0.5f * row[x] + 0.5f;
    }
  }
  return layers_of({std::move(normal[0]), std::move(normal[1]), std::move(normal[2])},
                   {"R", "G", "B"});
}

void invert(Plane& plane) {
  for (int y = 0; y < plane.height(); ++y) {
    float* row = plane.row(y);
    for (int x = 0; x < plane.width(); ++x) row[x] = 1.0f - row[x];
  }
}

}  // namespace kiln

// SPDX-License-Identifier: Apache-2.0
#include "slot_values.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "kiln/core/error.h"

namespace kiln {
namespace {

template <class Function>
void for_each_texel(Plane& plane, Function function) {
  for (int y = 0; y < plane.height(); ++y) {
    float* v = plane.row(y);
    for (int x = 0; x < plane.width(); ++x) v[x] = function(v[x]);
  }
}

// Applies function(value, channel) to a constant or to the planes of an image.
template <class Function>
void for_each_value(SlotMap& map, Function function) {
  if (map.value) {
    for (int c = 0; c < 3; ++c) (*map.value)[c] = function((*map.value)[c], c);
    return;
  }
  int channel = 0;
  for (Layer& layer : map.image.layers) {
    if (channel > 2 || (layer.name == "A" && channel > 0)) return;
    const int c = channel++;
    for_each_texel(layer.plane, [&](float value) { return function(value, c); });
  }
}

float turns_to_radians(AngleEncoding encoding) {
  constexpr float pi = std::numbers::pi_v<float>;
  if (encoding == AngleEncoding::Degrees) return pi / 180;
  return encoding == AngleEncoding::Radians ? 1.0f : 2 * pi;
}

float angle_of(float x, float y) { return std::atan2(2 * y - 1, 2 * x - 1); }

// Planes of an image that hold an angle: one, or the two of a direction.
const Plane& second_plane(const SlotMap& map) {
  if (map.decoding.angle != AngleEncoding::Direction) return map.image.layers[0].plane;
  if (map.image.layers.size() > 1) return map.image.layers[1].plane;
  throw Error(Fault::Input,
              "anisotropy_angle " + map.source + ": a direction has two channels, the map has one");
}

void decode_angle(SlotMap& map) {
  const bool direction = map.decoding.angle == AngleEncoding::Direction;
  const float unit = direction ? 1.0f : turns_to_radians(map.decoding.angle);
  const float offset = map.decoding.offset[0];
  const auto radians = [=](float u, float v) {
    return offset + (direction ? angle_of(u, v) : unit * u);
  };
  if (map.value) return map.value->fill(radians((*map.value)[0], (*map.value)[1]));
  const Plane &first = map.image.layers[0].plane, &second = second_plane(map);
  Layers axes = make_layers(map.image.size, {"R", "G"});
  for (int y = 0; y < axes.size.height; ++y) {
    const float *u = first.row(y), *v = second.row(y);
    float *cosine = axes.layers[0].plane.row(y), *sine = axes.layers[1].plane.row(y);
    for (int x = 0; x < axes.size.width; ++x) {
      const float twice = 2 * radians(u[x], v[x]);
      cosine[x] = std::cos(twice);
      sine[x] = std::sin(twice);
    }
  }
  map.image = std::move(axes);
}

// What was below 0 stays so, and is clamped and counted later.
void alpha_to_roughness(SlotMap& map) {
  for_each_value(map, [](float value, int) { return value > 0 ? std::sqrt(value) : value; });
}

// A single plane in the place of a colour, where its channels are scaled by themselves.
void spread_grey(SlotMap& map) {
  std::vector<Layer>& layers = map.image.layers;
  if (layers.empty() || layers.size() > 2) return;
  layers.resize(1);
  layers[0].name = "R";
  for (const char* name : {"G", "B"}) layers.push_back({name, layers[0].plane});
}

void scale_values(Slot slot, SlotMap& map) {
  const std::array<float, 3> scale = map.decoding.scale, offset = map.decoding.offset;
  if (scale == SlotDecoding{}.scale && offset == SlotDecoding{}.offset) return;
  if (slot_facts(slot).content == Content::Color && !map.value) spread_grey(map);
  for_each_value(map, [&](float value, int c) { return scale[c] * value + offset[c]; });
}

}  // namespace

void decode_slot(Slot slot, SlotMap& map) {
  if (slot == Slot::Normal) return;
  if (slot == Slot::AnisotropyAngle) return decode_angle(map);
  if (slot == Slot::Roughness && map.decoding.roughness == RoughnessEncoding::Alpha) {
    alpha_to_roughness(map);
  }
  scale_values(slot, map);
}

void multiply(Plane& plane, const Plane& factor, float most) {
  for (int y = 0; y < plane.height(); ++y) {
    float* v = plane.row(y);
    const float* f = factor.row(y);
    for (int x = 0; x < plane.width(); ++x) v[x] = std::min(v[x] * f[x], most);
  }
}

long long replace_unreadable(Plane& plane) {
  long long count = 0;
  for_each_texel(plane, [&](float value) {
    const bool finite = std::isfinite(value);
    count += !finite;
    return finite ? value : 0.0f;
  });
  return count;
}

Plane angle_of_axes(const Layers& axes) {
  Plane angle = axes.layers[0].plane;
  for (int y = 0; y < angle.height(); ++y) {
    const float* sine = axes.layers[1].plane.row(y);
    float* v = angle.row(y);
    for (int x = 0; x < angle.width(); ++x) v[x] = 0.5f * std::atan2(sine[x], v[x]);
  }
  return angle;
}

void bring_to_shape(AnisotropyEncoding encoding, Plane& roughness, Plane& anisotropy) {
  if (encoding == AnisotropyEncoding::Burley) return;
  for (int y = 0; y < roughness.height(); ++y) {
    float* r = roughness.row(y);
    float* a = anisotropy.row(y);
    for (int x = 0; x < roughness.width(); ++x) {
      const LobeShape shape = lobe_shape(encoding, r[x], a[x]);
      r[x] = shape.roughness;
      a[x] = shape.anisotropy;
    }
  }
}

}  // namespace kiln

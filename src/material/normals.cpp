// SPDX-License-Identifier: Apache-2.0
#include "kiln/material/normals.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "kiln/core/error.h"

namespace kiln {
namespace {

constexpr float least_length = 0.05f;  // of a stored normal that still has a direction
constexpr float code_step = 1.0f / 255.0f;

// How red and green become x and y: x = scale * (v - zero), the two middle codes to 0 if asked.
struct Component {
  float scale = 2.0f;
  float zero = 0.5f;
  float dead_zone = 0.0f;  // of |x|: the middle codes of 8 bits lie just inside

  float operator()(float stored) const {
    const float x = scale * (stored - zero);
    return std::abs(std::abs(x) - code_step) < dead_zone ? 0.0f : x;
  }
};

Component component_of(NormalZero zero, bool signed_range) {
  if (signed_range) return {1.0f, 0.0f, 0.0f};
  switch (zero) {
    case NormalZero::Both:
      return {2.0f, 0.5f, 1e-6f};
    case NormalZero::Exact:
      return {2.0f, 0.5f, 0.0f};
    case NormalZero::Code127:
      return {2.0f, 127 * code_step, 0.0f};
    case NormalZero::Code128:
      return {2.0f, 128 * code_step, 0.0f};
  }
  return {};
}

struct Extremes {
  float min = 0;
  float max = 0;
};

Extremes extremes_of(const Plane& plane) {
  Extremes found{plane.at(0, 0), plane.at(0, 0)};
  for (int y = 0; y < plane.height(); ++y) {
    for (const float v : plane.texels_of_row(y)) {
      found.min = std::min(found.min, v);
      found.max = std::max(found.max, v);
    }
  }
  return found;
}

bool is_constant(const Plane& plane) {
  const Extremes found = extremes_of(plane);
  return found.max - found.min < 1e-6f;
}

// A little ringing below zero is no sign of components stored as they are.
bool is_signed(const Layers& stored, NormalRange range) {
  if (range != NormalRange::Auto) return range == NormalRange::Signed;
  constexpr float ringing = -0.05f;
  return extremes_of(stored.layers[0].plane).min < ringing ||
         extremes_of(stored.layers[1].plane).min < ringing;
}

bool has_third_component(const Layers& stored, NormalLayout layout) {
  if (layout != NormalLayout::Auto) return layout == NormalLayout::ThreeChannel;
  if (stored.layers.size() < 3 || stored.layers[2].name == "A") return false;
  if (!is_constant(stored.layers[2].plane)) return true;
  return is_constant(stored.layers[0].plane) && is_constant(stored.layers[1].plane);
}

void strengthen_row(std::array<float*, 3> n, int width, float strength) {
  for (int i = 0; i < width; ++i) {
    n[0][i] *= strength;
    n[1][i] *= strength;
  }
}

// Grey that varies: directions never do that, for a unit vector on the diagonal is one only.
bool is_grey_relief(const Layers& stored) {
  if (stored.layers.size() < 3 || stored.layers[2].name == "A") return false;
  const Plane &r = stored.layers[0].plane, &g = stored.layers[1].plane, &b = stored.layers[2].plane;
  for (int y = 0; y < r.height(); ++y) {
    const auto red = r.texels_of_row(y), green = g.texels_of_row(y), blue = b.texels_of_row(y);
    if (!std::equal(red.begin(), red.end(), green.begin()) ||
        !std::equal(red.begin(), red.end(), blue.begin())) {
      return false;
    }
  }
  constexpr float visible = 0.02f;
  const Extremes found = extremes_of(r);
  return found.max - found.min > visible;
}

// Those with a direction whose length is more than rounding from 1. NaN and Inf compare as neither.
int count_not_unit(const std::array<float*, 3>& n, int width) {
  constexpr float rounding = 1e-4f;
  constexpr float low = 1 - unit_tolerance - rounding, high = 1 + unit_tolerance + rounding;
  constexpr float largest = std::numeric_limits<float>::max();
  int count = 0;
  for (int i = 0; i < width; ++i) {
    const float squared = n[0][i] * n[0][i] + n[1][i] * n[1][i] + n[2][i] * n[2][i];
    const bool is_short = squared >= least_length * least_length && squared < low * low;
    const bool is_long = squared > high * high && squared <= largest;
    count += is_short || is_long;
  }
  return count;
}

// One row of components to unit vectors above the surface.
void make_unit_row(std::array<float*, 3> n, int width, DecodedNormals& counts) {
  int degenerate = 0, below = 0, unreadable = 0;
  for (int i = 0; i < width; ++i) {
    float x = n[0][i], y = n[1][i], z = n[2][i];
    const float squared = x * x + y * y + z * z;
    const bool readable = std::isfinite(squared);
    const bool directed = squared >= least_length * least_length;
    unreadable += !readable;
    degenerate += readable && !directed;
    const bool kept = readable && directed;
    x = kept ? x : 0.0f;
    y = kept ? y : 0.0f;
    z = kept ? z : 1.0f;
    below += z <= 0.0f;
    z = z <= 0.0f ? least_normal_z : z;
    const float inverse = 1.0f / std::sqrt(x * x + y * y + z * z);
    n[0][i] = x * inverse;
    n[1][i] = y * inverse;
    n[2][i] = z * inverse;
  }
  counts.degenerate += degenerate;
  counts.below_surface += below;
  counts.unreadable += unreadable;
}

// z of a two-channel map; beyond the unit circle it comes out 0 and is raised later. NaN stays.
void rebuild_z_row(std::array<float*, 3> n, int width) {
  for (int i = 0; i < width; ++i) {
    const float squared = 1.0f - n[0][i] * n[0][i] - n[1][i] * n[1][i];
    n[2][i] = squared < 0.0f ? 0.0f : std::sqrt(squared);
  }
}

}  // namespace

DecodedNormals decode_normals(const Layers& stored, const NormalDecoding& decoding) {
  if (is_grey_relief(stored)) {
    throw Error(Fault::Input,
                "red, green and blue are equal everywhere: this is a height map in the place of "
                "normals; fill the slot `height` with it");
  }
  if (stored.layers.size() < 2) {
    throw Error(Fault::Input, "a normal map has two or three channels, this one has one");
  }
  DecodedNormals decoded;
  decoded.signed_range = is_signed(stored, decoding.range);
  decoded.two_channel = !has_third_component(stored, decoding.layout);
  const Component xy = component_of(decoding.zero, decoded.signed_range);
  const Component z = component_of(NormalZero::Exact, decoded.signed_range);
  const float up = decoding.convention == NormalConvention::DirectX ? -1.0f : 1.0f;
  for (Plane& plane : decoded.normal) plane = Plane(stored.size);
  for (int row = 0; row < stored.size.height; ++row) {
    const std::array<float*, 3> n = {decoded.normal[0].row(row), decoded.normal[1].row(row),
                                     decoded.normal[2].row(row)};
    const float* stored_x = stored.layers[0].plane.row(row);
    const float* stored_y = stored.layers[1].plane.row(row);
    for (int i = 0; i < stored.size.width; ++i) {
      n[0][i] = xy(stored_x[i]);
      n[1][i] = up * xy(stored_y[i]);
    }
    if (decoded.two_channel) {
      rebuild_z_row(n, stored.size.width);
    } else {
      const float* stored_z = stored.layers[2].plane.row(row);
      for (int i = 0; i < stored.size.width; ++i) n[2][i] = z(stored_z[i]);
    }
    decoded.not_unit += count_not_unit(n, stored.size.width);
    if (decoding.strength != 1.0f) strengthen_row(n, stored.size.width, decoding.strength);
    make_unit_row(n, stored.size.width, decoded);
  }
  return decoded;
}

void flip_y(std::array<Plane, 3>& normal) {
  for (int row = 0; row < normal[1].height(); ++row) {
    float* y = normal[1].row(row);
    for (int i = 0; i < normal[1].width(); ++i) y[i] = -y[i];
  }
}

}  // namespace kiln
